// Drawing of one plot on a canvas: axes at round numbers, and filled or hollow points, joined by
// thin lines from frame to frame.
window.tofscope ??= {};
{
  const LEFT = 44, RIGHT = 8, TOP = 4;  // pixels beside the area of the points
  const MANY = 4000;  // points from which on they are drawn as a raster of cells
  const CELL = 2;  // pixels of a cell
  const FILLED = 1, HOLLOW = 2;

  // The least number of some steps times a power of ten that is not below `value`.
  const roundUp = (value, steps = [1, 2, 5, 10]) => {
    if (!(value > 0)) return 1;
    const power = 10 ** Math.floor(Math.log10(value));
    return steps.map(step => step * power).find(step => step >= value * (1 - 1e-9));
  };

  // Numbers at a round distance between the ends of an axis, at least `space` pixels apart unless
  // there were then no two.
  const ticks = (axis, pixels, space) => {
    let step = roundUp((axis.high - axis.low) * space / Math.max(pixels, 1));
    const ends = () =>
      [Math.ceil(axis.low / step - 1e-9), Math.floor(axis.high / step + 1e-9)];
    let [first, last] = ends();
    if (last <= first) {
      step = roundUp(0.4 * step);
      [first, last] = ends();
    }
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
    height: Math.max(height - TOP - (labelled ? 32 : 4), 1),
  });

  const drawAxes = (context, area, x, y, {labelled, text, large}) => {
    const {left, top, width, height} = area;
    context.font = `${large ? 12 : 10}px sans-serif`;
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
    for (const {value, text: said} of ticks(y, height, Math.max(24, height / 10))) {
      const at = top + height * (y.high - value) / (y.high - y.low);
      line(left, at, left + width, at, value === 0 ? 0.35 : 0.1);
      context.globalAlpha = 0.8;
      context.fillText(said, left - 5, Math.min(Math.max(at, 5), top + height - 1));
    }
    context.textBaseline = "top";
    for (const {value, text: said} of ticks(x, width, Math.max(56, width / 16))) {
      const at = left + width * (value - x.low) / (x.high - x.low);
      line(at, top, at, top + height, 0.1);
      context.globalAlpha = 0.8;
      context.textAlign = at < left + 12 ? "left" : at > left + width - 12 ? "right" : "center";
      if (labelled) context.fillText(said, at, top + height + 3);
    }
    if (!labelled) return;
    context.textAlign = "right";
    context.fillText(x.title, left + width, top + height + 17);
  };

  // Draws series of points {x, y, counts, colour, size}; hollow where `counts` is 0. Those with
  // `joined` have a thin line from each frame to the next.
  const drawPoints = (context, area, x, y, series, from, to) => {
    for (const one of series) {
      const place = placing(area, x, y, one);
      context.fillStyle = context.strokeStyle = one.colour;
      context.lineWidth = 1;
      if (to - from > MANY) {
        drawCells(context, area, place, one, from, to);
        continue;
      }
      if (one.joined) drawLine(context, place, one, from, to);
      drawDots(context, place, one, from, to);
    }
    context.globalAlpha = 1;
  };

  // Where a frame's point is, in pixels of the canvas, and whether the area holds it.
  const placing = ({left, top, width, height}, x, y, {x: xs, y: ys}) => {
    const across = width / (x.high - x.low), up = height / (y.high - y.low);
    return {
      right: frame => left + across * (xs[frame] - x.low),
      down: frame => top + up * (y.high - ys[frame]),
      // False for NaN, too.
      holds: (right, down) =>
        right >= left && right <= left + width && down >= top && down <= top + height,
    };
  };

  const drawDots = (context, place, {counts, size, alpha}, from, to) => {
    const filled = new Path2D(), hollow = new Path2D();
    for (let k = from; k < to; k++) {
      const right = place.right(k), down = place.down(k);
      if (!place.holds(right, down)) continue;
      const path = counts !== null && counts[k] === 0 ? hollow : filled;
      path.moveTo(right + size, down);
      path.arc(right, down, size, 0, 2 * Math.PI);
    }
    context.globalAlpha = alpha;
    context.fill(filled);
    context.stroke(hollow);
  };

  const drawLine = (context, place, {alpha}, from, to) => {
    const path = new Path2D();
    let before = false;
    for (let k = from; k < to; k++) {
      const right = place.right(k), down = place.down(k), known = place.holds(right, down);
      if (known && before) path.lineTo(right, down);
      else if (known) path.moveTo(right, down);
      before = known;
    }
    context.globalAlpha = 0.3 * alpha;
    context.stroke(path);
  };

  // Dense points: cells that hold a filled point, and, pale, those that hold hollow ones alone.
  const drawCells = (context, area, place, {counts, alpha}, from, to) => {
    const columns = Math.ceil(area.width / CELL) + 1, rows = Math.ceil(area.height / CELL) + 1;
    const cells = new Uint8Array(columns * rows);
    for (let k = from; k < to; k++) {
      const right = place.right(k), down = place.down(k);
      if (!place.holds(right, down)) continue;
      const cell = Math.floor((right - area.left) / CELL) * rows
        + Math.floor((down - area.top) / CELL);
      if (cells[cell] !== FILLED) cells[cell] = counts !== null && counts[k] === 0 ? HOLLOW : FILLED;
    }
    for (const [state, share] of [[HOLLOW, 0.35], [FILLED, 1]]) {
      context.globalAlpha = alpha * share;
      context.beginPath();
      for (let column = 0; column < columns; column++) {
        for (let row = 0; row < rows; row++) {
          const start = row;
          while (row < rows && cells[column * rows + row] === state) row++;
          if (row > start) {
            const [right, down] = [area.left + column * CELL, area.top + start * CELL];
            context.rect(right, down, CELL, (row - start) * CELL);
          }
        }
      }
      context.fill();
    }
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
