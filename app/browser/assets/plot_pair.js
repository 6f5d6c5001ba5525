// Plot of two quantities against each other; its points are the frames of the recording.
window.tofscope ??= {};
{
  const data = window.tofscope.plotData;
  const {areaOf, drawAxes, drawPoints, fitted} = window.tofscope.plotDrawing;
  const REACH = 12;  // pixels within which a point is hovered
  const labelOf = ({title, unit}) => unit ? `${title} [${unit}]` : title;
  let plot = null;

  const build = (parent, pair, {made, on, hover, seek}) => {
    parent.replaceChildren();
    plot = null;
    if (!pair) return;
    const heading = made("div", "plot-heading", parent);
    const title = made("span", "plot-title", heading);
    title.textContent = `${labelOf(pair.y)} against ${labelOf(pair.x)}`;
    const area = made("div", "plot-area", parent);
    area.dataset.plot = "pair";
    plot = {
      pair, area, canvas: made("canvas", "", area), places: [],
      ring: made("div", "plot-ring", area), hover: made("div", "plot-ring hovered", area),
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
    const box = plot.area.getBoundingClientRect();
    let best = null, least = REACH ** 2;
    for (const {x, y} of plot.places) {
      for (let k = 0; k < x.length; k++) {
        const distance = (plot.right(x[k]) - event.clientX + box.left) ** 2
          + (plot.down(y[k]) - event.clientY + box.top) ** 2;
        if (distance <= least) [best, least] = [k, distance];
      }
    }
    return best;
  };

  const draw = (state, {text, height, axisOf}) => {
    if (!plot) return;
    plot.area.style.height = `${height}px`;
    const {context, width, height: high} = fitted(plot.canvas);
    const area = areaOf(width, high, true), {x: across, y: up} = plot.pair;
    const series = state.shown.map((of, index) => ({
      x: data.values(across.name, of), y: data.values(up.name, of), counts: data.counts(of),
      colour: state.colours[of], size: index ? 1.6 : 2.2, alpha: data.alpha(of),
    }));
    const size = data.times.length;
    const ends = across.name === "time" ? {...across, top: data.seconds} : across;
    const x = {...axisOf(ends, series.map(one => one.x), 0, size), title: labelOf(across)};
    const y = axisOf(up, series.map(one => one.y), 0, size);
    plot.places = series;
    plot.right = value => area.left + area.width * (value - x.low) / (x.high - x.low);
    plot.down = value => area.top + area.height * (y.high - value) / (y.high - y.low);
    drawAxes(context, area, x, y, {labelled: true, text});
    drawPoints(context, area, x, y, series, 0, size);
  };

  // Rings around the points of the current and of the hovered frame.
  const mark = state => {
    if (!plot || !plot.places.length) return;
    const [{x, y}] = plot.places;
    for (const [ring, frame] of [[plot.ring, state.frame], [plot.hover, state.hovered]]) {
      const [right, down] = [plot.right(x[frame]), plot.down(y[frame])];
      ring.style.display = Number.isFinite(right + down) ? "block" : "none";
      Object.assign(ring.style, {left: `${right}px`, top: `${down}px`});
    }
  };

  window.tofscope.plotPair = {build, draw, mark};
}
