// Draws the image of one sensor, zone by zone, with signs in zones that have no point.
window.tofscope ??= {};
{
  const tofscope = window.tofscope;
  const READABLE = 22;  // pixels of a zone that holds a number
  const STATES = 200;  // values from here on are states of zones, in the session's order
  const [REFUSED, TOO_FAR, ROBOT, UNPLACED] = [2, 3, 4, 5].map(state => STATES + state);

  // `image`: {rows, columns, value(row, column), moves(row, column), texts}; `colours`: four bytes
  // for each value; `moving`: colour of the outline around zones with something that moves.
  tofscope.drawZones = (canvas, image, width, {colours, moving}) => {
    const height = width * image.rows / image.columns, ratio = window.devicePixelRatio || 1;
    canvas.style.width = `${width}px`;
    canvas.style.height = `${height}px`;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const context = canvas.getContext("2d");
    context.scale(ratio, ratio);
    const size = width / image.columns, ink = getComputedStyle(canvas).color;
    for (let row = 0; row < image.rows; row++) {
      for (let column = 0; column < image.columns; column++) {
        const value = image.value(row, column), x = column * size, y = row * size;
        const [red, green, blue, alpha] = colours.subarray(4 * value, 4 * value + 4);
        if (alpha) {
          context.fillStyle = `rgb(${red} ${green} ${blue})`;
          context.fillRect(x, y, size + 0.3, size + 0.3);
        }
        const text = size >= READABLE && image.texts?.[row * image.columns + column];
        const light = red + 2 * green > 380;
        if (text) write(context, text, x, y, size, alpha ? (light ? "#111" : "#fff") : ink);
        else if (value >= STATES) sign(context, value, x, y, size, ink);
      }
    }
    const edge = outline(image, size), thick = Math.max(1.5, size / 10);
    for (const [colour, width] of [["#fff", thick + 1.5], [moving, thick]]) {
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.stroke(edge);
    }
  };

  const sign = (context, value, x, y, size, ink) => {
    context.strokeStyle = context.fillStyle = ink;
    context.globalAlpha = 0.55;
    context.lineWidth = Math.max(0.8, size / 14);
    const inset = 0.28 * size, far = size - inset;
    context.beginPath();
    if (value === REFUSED || value === ROBOT) {
      context.moveTo(x + inset, y + far);
      context.lineTo(x + far, y + inset);
    }
    if (value === REFUSED) {
      context.moveTo(x + inset, y + inset);
      context.lineTo(x + far, y + far);
    }
    if (value === UNPLACED) context.rect(x + inset, y + inset, far - inset, far - inset);
    context.stroke();
    if (value === TOO_FAR) {
      context.arc(x + size / 2, y + size / 2, Math.max(0.13 * size, 0.7), 0, 7);
      context.fill();
    }
    context.globalAlpha = 1;
  };

  const write = (context, text, x, y, size, ink) => {
    context.fillStyle = ink;
    context.font = `${Math.min(0.36 * size, 13)}px system-ui, sans-serif`;
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.fillText(text, x + size / 2, y + size / 2);
  };

  // Path along the edges between zones that move and zones that do not.
  const outline = ({rows, columns, moves}, size) => {
    const path = new Path2D();
    const inside = (row, column) =>
      row >= 0 && column >= 0 && row < rows && column < columns && moves(row, column);
    const line = (x1, y1, x2, y2) => {
      path.moveTo(x1 * size, y1 * size);
      path.lineTo(x2 * size, y2 * size);
    };
    for (let row = 0; row < rows; row++) {
      for (let column = 0; column < columns; column++) {
        if (!inside(row, column)) continue;
        if (!inside(row - 1, column)) line(column, row, column + 1, row);
        if (!inside(row + 1, column)) line(column, row + 1, column + 1, row + 1);
        if (!inside(row, column - 1)) line(column, row, column, row + 1);
        if (!inside(row, column + 1)) line(column + 1, row, column + 1, row + 1);
      }
    }
    return path;
  };
}
