// Drawing of one plot on a canvas: axes at round numbers, and filled or hollow points.
window.tofscope ??= {};
{
  const FONT = "10px sans-serif";
  const LEFT = 44, RIGHT = 8, TOP = 4;  // pixels beside the area of the points
  const MANY = 4000;  // points from which on they are small squares, which are faster to draw

  // The least number of some steps times a power of ten that is not below `value`.
  const roundUp = (value, steps = [1, 2, 5, 10]) => {
    if (!(value > 0)) return 1;
    const power = 10 ** Math.floor(Math.log10(value));
    return steps.map(step => step * power).find(step => step >= value * (1 - 1e-9));
  };

  // Numbers at a round distance between the ends of an axis, at least `space` pixels apart.
  const ticks = (axis, pixels, space) => {
    const step = roundUp((axis.high - axis.low) * space / Math.max(pixels, 1));
    const first = Math.ceil(axis.low / step - 1e-9), last = Math.floor(axis.high / step + 1e-9);
    const decimals = Math.min(Math.max(-Math.floor(Math.log10(step) + 1e-9), 0), 9);
    return Array.from({length: Math.max(last - first + 1, 0)}, (_, k) => {
      const value = (first + k) * step;
      const text = Math.abs(value) >= 1e5 ? value.toExponential(0) : value.toFixed(decimals);
      return {value, text: text.replace("-", "−")};
    });
  };

  // Pixels of the area of the points within a plot of this size.
  const areaOf = (width, height, labelled) => ({
    left: LEFT,
    top: TOP,
    width: Math.max(width - LEFT - RIGHT, 1),
    height: Math.max(height - TOP - (labelled ? 28 : 4), 1),
  });

  const drawAxes = (context, area, x, y, {labelled, text}) => {
    const {left, top, width, height} = area;
    context.font = FONT;
    context.strokeStyle = context.fillStyle = text;
    const line = (x0, y0, x1, y1, alpha) => {
      context.globalAlpha = alpha;
      context.beginPath();
      context.moveTo(Math.round(x0) + 0.5, Math.round(y0) + 0.5);
      context.lineTo(Math.round(x1) + 0.5, Math.round(y1) + 0.5);
      context.stroke();
    };
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (const {value, text: said} of ticks(y, height, 24)) {
      const at = top + height * (y.high - value) / (y.high - y.low);
      line(left, at, left + width, at, value === 0 ? 0.35 : 0.1);
      context.globalAlpha = 0.8;
      context.fillText(said, left - 5, Math.min(Math.max(at, 5), top + height - 1));
    }
    context.textBaseline = "top";
    for (const {value, text: said} of ticks(x, width, 56)) {
      const at = left + width * (value - x.low) / (x.high - x.low);
      line(at, top, at, top + height, 0.1);
      context.globalAlpha = 0.8;
      context.textAlign = at < left + 12 ? "left" : at > left + width - 12 ? "right" : "center";
      if (labelled) context.fillText(said, at, top + height + 3);
    }
    if (!labelled) return;
    context.textAlign = "right";
    context.fillText(x.title, left + width, top + height + 15);
  };

  // Draws series of points {x, y, counts, colour, size}; hollow where `counts` is 0.
  const drawPoints = (context, area, x, y, series, from, to) => {
    const {left, top, width, height} = area;
    const many = to - from > MANY;
    // Of several points in one cell one is drawn, which looks the same.
    const cell = many ? 3 : 2;
    const columns = Math.ceil(width / cell) + 1, rows = Math.ceil(height / cell) + 1;
    const seen = new Uint8Array(columns * rows);
    for (const {x: xs, y: ys, counts, colour, size, alpha} of series) {
      for (const hollow of [true, false]) {
        seen.fill(0);
        context.beginPath();
        for (let k = from; k < to; k++) {
          if (hollow !== (counts !== null && counts[k] === 0)) continue;
          const right = width * (xs[k] - x.low) / (x.high - x.low);
          const down = height * (y.high - ys[k]) / (y.high - y.low);
          if (!(right >= 0 && right <= width && down >= 0 && down <= height)) continue;
          const place = Math.floor(right / cell) * rows + Math.floor(down / cell);
          if (seen[place]) continue;
          seen[place] = 1;
          if (many) {
            context.rect(left + right - size / 2, top + down - size / 2, size, size);
            continue;
          }
          context.moveTo(left + right + size, top + down);
          context.arc(left + right, top + down, size, 0, 2 * Math.PI);
        }
        context.globalAlpha = alpha;
        context.fillStyle = context.strokeStyle = colour;
        context.lineWidth = 1;
        if (hollow) context.stroke(); else context.fill();
      }
    }
    context.globalAlpha = 1;
  };

  // A canvas fitted to its element, cleared, with its size in CSS pixels.
  const fitted = canvas => {
    const ratio = window.devicePixelRatio || 1;
    const width = canvas.clientWidth, height = canvas.clientHeight;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const context = canvas.getContext("2d");
    context.scale(ratio, ratio);
    return {context, width, height};
  };

  window.tofscope.plotDrawing = {roundUp, areaOf, drawAxes, drawPoints, fitted};
}
