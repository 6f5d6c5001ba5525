// What the pointer does over a plot over time: hover, drag to zoom, click to go, double click back.
window.tofscope ??= {};
{
  const DRAG = 4;  // pixels from which on a press is a drag
  const TWICE = 250;  // milliseconds within which a second click may make a double click
  let seeking = 0;

  // `on` adds listeners; `timeAt(event)` is the time under the pointer; `zoomed()` says whether a
  // part is shown; `hover`, `select` and `zoom` take a time or a span of times, or null.
  const listen = (area, {on, timeAt, zoomed, hover, select, zoom, seek}) => {
    let start = null, from = 0, span = null;
    const letGo = () => {
      start = span = null;
      select(null);
    };
    on(area, "pointerdown", event => {
      if (event.button !== 0) return;
      start = event.clientX;
      from = timeAt(event);
      area.setPointerCapture(event.pointerId);
    });
    on(area, "pointermove", event => {
      const time = timeAt(event);
      if (start !== null && (span || Math.abs(event.clientX - start) > DRAG)) {
        span = [from, time].sort((a, b) => a - b);
        select(span);
      }
      hover(time);
    });
    on(area, "pointerup", event => {
      if (start === null) return;
      if (span) {
        zoom(span);
      } else {
        const time = timeAt(event);
        clearTimeout(seeking);
        // A click may be the first of a double click, where that has a meaning.
        if (zoomed() && event.pointerType === "mouse")
          seeking = setTimeout(() => seek(time), TWICE);
        else seek(time);
      }
      letGo();
    });
    on(area, "pointercancel", letGo);
    on(area, "pointerleave", () => { if (start === null) hover(null); });
    on(area, "dblclick", () => {
      clearTimeout(seeking);
      zoom(null);
    });
  };

  window.tofscope.plotPointer = {listen};
}
