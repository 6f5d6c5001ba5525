// Plot of two quantities against each other; its points are the frames of the recording.
window.tofscope ??= {};
{
  const {element: made, plotData: data} = window.tofscope;
  const {areaOf, drawAxes, drawPoints, fitted} = window.tofscope.plotDrawing;
  const REACH = 12;  // pixels within which a point is hovered
  const labelOf = ({title, unit}) => unit ? `${title} [${unit}]` : title;
  let plot = null;

  const build = (parent, pair, {on, hover, seek}) => {
    parent.replaceChildren();
    plot = null;
    if (!pair) return;
    const heading = made("div", "plot-heading", parent);
    made("span", "plot-title", heading, `${labelOf(pair.y)} against ${labelOf(pair.x)}`);
    const area = made("div", "plot-area", parent);
    area.dataset.plot = "pair";
    plot = {
      pair, heading, area, canvas: made("canvas", "", area), places: [], from: 0, to: 0,
      ring: made("div", "plot-ring", area), hover: made("div", "plot-ring hovered", area),
      values: made("span", "plot-values", heading),
    };
    on(area, "pointermove", event => hover(nearestTo(event)));
    on(area, "pointerleave", () => hover(null));
    on(area, "click", event => {
      const frame = nearestTo(event);
      if (frame !== null) seek(frame);
    });
  };

  // The frame whose point is nearest to the pointer, null where none is near.
  const nearestTo = event => {
    if (!plot.x) return null;
    const box = plot.area.getBoundingClientRect(), {x, y} = plot;
    const across = (x.high - x.low) / plot.within.width, up = (y.high - y.low) / plot.within.height;
    const at = x.low + (event.clientX - box.left - plot.within.left) * across;
    const on = y.high - (event.clientY - box.top - plot.within.top) * up;
    let best = null, least = REACH ** 2;
    for (const {x: xs, y: ys} of plot.places) {
      for (let k = plot.from; k < plot.to; k++) {
        const distance = ((xs[k] - at) / across) ** 2 + ((ys[k] - on) / up) ** 2;
        if (distance <= least) [best, least] = [k, distance];
      }
    }
    return best;
  };

  // Draws the frames from `from` to before `to`, as high as `height` pixels.
  const draw = (state, {text, large, height, axisOf, from, to}) => {
    if (!plot) return;
    plot.area.style.height = `${height - plot.heading.offsetHeight}px`;
    const {context, width, height: high} = fitted(plot.canvas);
    const area = plot.within = areaOf(width, high, true), {x: across, y: up} = plot.pair;
    const series = state.shown.map((of, index) => ({
      x: data.values(across.name, of), y: data.values(up.name, of), counts: data.counts(of),
      colour: state.colours[of], alpha: data.alpha(of), joined: false,
      size: (index ? 1.6 : 2.2) * (large ? 1.5 : 1),
    }));
    const x = plot.x = across.name === "time" && state.view
      ? {low: state.view[0], high: state.view[1]}
      : axisOf(across.name === "time" ? {...across, top: data.seconds} : across,
        series.map(one => one.x), from, to);
    x.title = labelOf(across);
    const y = plot.y = axisOf(up, series.map(one => one.y), from, to);
    Object.assign(plot, {places: series, from, to});
    drawAxes(context, area, x, y, {labelled: true, text, large});
    drawPoints(context, area, x, y, series, from, to);
  };

  // Rings around the points of the current and of the hovered frame, and its values.
  const mark = (state, frame) => {
    if (!plot?.x || !plot.places.length) return;
    const {within, x, y, pair, places: [{x: xs, y: ys}]} = plot;
    for (const [ring, at] of [[plot.ring, state.frame], [plot.hover, state.hovered]]) {
      const right = within.left + within.width * (xs[at] - x.low) / (x.high - x.low);
      const down = within.top + within.height * (y.high - ys[at]) / (y.high - y.low);
      const known = at !== null && at >= plot.from && at < plot.to && Number.isFinite(right + down);
      ring.style.display = known ? "block" : "none";
      Object.assign(ring.style, {left: `${right}px`, top: `${down}px`});
    }
    plot.values.textContent = plot.places.map((one, index) => {
      const said = [[one.x, pair.x], [one.y, pair.y]].map(
        ([numbers, quantity]) => data.written(numbers[frame], quantity));
      return `${plot.places.length > 1 ? `${state.shown[index]} ` : ""}(${said.join(", ")})`;
    }).join("  ");
  };

  window.tofscope.plotPair = {build, draw, mark};
}
