// Images of all sensors in a grid, zone by zone, and the selected one enlarged below.
window.tofscope ??= {};
if (!window.tofscope.sensors) {
  const {tofscope} = window, {element, bytes} = tofscope;
  const HOST = "tofscope-sensors", GAP = 4, CAPTION = 14, TALLEST = 360;
  const SMALLEST = 40, IN_ROWS = 26, LARGEST = 120;  // pixels of an image's width
  let layout = null, images = null, marks = {}, seen = false, host = null, tiles = [], big = null;


  const imageOf = sensor => {
    const [rows, columns] = layout.grids[sensor], at = layout.starts[sensor];
    return {
      rows, columns,
      value: (row, column) => images.values[at + row * columns + column],
      moves: (row, column) => {
        const index = at + row * columns + column;
        return Boolean(images.moves[index >> 3] & (128 >> (index & 7)));
      },
    };
  };

  const enlarged = ({rows, columns, values, moves, texts}) => ({
    rows, columns, texts,
    value: (row, column) => values[row * columns + column],
    moves: (row, column) => {
      const index = row * columns + column;
      return Boolean(moves[index >> 3] & (128 >> (index & 7)));
    },
  });

  // ---- elements

  // Number of columns, and width: a row for each group, else as large as fits into a height,
  // unless they get too small to be read.
  const sizeOfTiles = (room, count) => {
    if (layout.groups.length > 1) {
      const most = Math.max(...layout.groups.map(({sensors}) => sensors.length));
      const width = columns => Math.floor((room - (columns - 1) * GAP) / columns);
      const columns = width(most) < IN_ROWS ? Math.ceil(most / 2) : most;
      return [columns, Math.min(width(columns), LARGEST)];
    }
    for (let columns = 1; ; columns++) {
      const width = Math.floor((room - (columns - 1) * GAP) / columns);
      const tall = Math.ceil(count / columns) * (width + CAPTION + GAP);
      if (tall <= TALLEST || width < SMALLEST + 10) return [columns, width];
    }
  };

  const buildTile = (sensor, grid) => {
    const tile = element("div", "tofscope-sensor", grid);
    tile.dataset.sensor = sensor;
    element("canvas", "", tile).dataset.zones = sensor;
    element("div", "tofscope-sensor-name", tile, layout.captions[sensor]).title = layout.names[sensor];
    return tile;
  };

  const build = () => {
    host.replaceChildren();
    host.tofscopeBuilt = layout;
    element("div", "tofscope-sensors-title", host);
    element("div", "tofscope-sensors-moving", host);
    const grids = element("div", "tofscope-sensors-grids", host);
    tiles = [];
    for (const {name, sensors} of layout.groups) {
      if (name) element("div", "tofscope-sensors-group", grids, name);
      const grid = element("div", "tofscope-sensors-grid", grids);
      for (const sensor of sensors) tiles[sensor] = buildTile(sensor, grid);
    }
    big = element("div", "tofscope-sensor-big", host);
    element("div", "tofscope-sensors-legend", host);
  };

  const show = () => {
    if (!host || !layout || !images) return;
    if (host.tofscopeBuilt !== layout || !host.childElementCount) build();
    const room = host.clientWidth;
    if (!room) return;
    const [title, moving, grids, , legend] = host.children;
    title.textContent = images.title;
    showMoving(moving);
    const [columns, width] = sizeOfTiles(room, tiles.length);
    grids.hidden = tiles.length === 1;  // it is shown enlarged
    for (const grid of grids.querySelectorAll(".tofscope-sensors-grid")) {
      grid.style.gap = `${GAP}px`;
      grid.style.gridTemplateColumns = `repeat(${columns}, ${width}px)`;
    }
    tiles.forEach((tile, sensor) => {
      tile.classList.toggle("moves", images.counts[sensor] > 0);
      tile.classList.toggle("absent", images.absent.includes(sensor));
      tile.classList.toggle("late", images.late.includes(sensor));
      tile.style.setProperty("--moving", images.moving);
      tile.dataset.count = images.counts[sensor] || "";
      tofscope.drawZones(tile.firstChild, imageOf(sensor), width, images);
    });
    showBig(room);
    showLegend(legend);
    showMarks();
  };

  const showMoving = box => {
    box.replaceChildren();
    const order = [...images.counts.keys()].filter(sensor => images.counts[sensor]);
    order.sort((a, b) => images.counts[b] - images.counts[a]);
    element("span", "", box, order.length ? "Something moves in front of " : "No motion found.");
    for (const sensor of order.slice(0, 8)) {
      const zones = sensor === order[0] ? " zones" : "";
      const text = `${layout.names[sensor]} (${images.counts[sensor]}${zones})`;
      const button = element("button", "tofscope-sensor-link", box, text);
      button.title = `${images.counts[sensor]} zones with something that moves`;
      button.dataset.sensor = sensor;
    }
    if (order.length > 8) element("span", "", box, `and ${order.length - 8} more`);
  };

  const showBig = room => {
    const chosen = images.selected;
    big.hidden = !chosen;
    if (!chosen) return;
    if (big.childElementCount !== 2) {
      big.replaceChildren();
      element("div", "tofscope-sensor-big-name", big);
      element("canvas", "", big);
    }
    big.dataset.sensor = chosen.sensor;
    big.firstChild.textContent = chosen.title;
    big.lastChild.dataset.zones = chosen.sensor;
    tofscope.drawZones(big.lastChild, enlarged(chosen), Math.min(room, 340), images);
  };

  const showLegend = box => {
    box.replaceChildren();
    if (images.ramp) {
      const ramp = element("div", "tofscope-sensors-ramp", box);
      const gradient = `linear-gradient(to right, ${images.ramp.join(", ")})`;
      images.ticks.forEach((tick, index) => {
        if (index > 0) {
          const part = (index - 1) / (images.ticks.length - 2);
          element("span", "bar", ramp).style.background =
            `${gradient} ${100 * part}% / ${100 * (images.ticks.length - 1)}%`;
        }
        element("span", "", ramp, tick);
      });
    }
    for (const [sign, text] of images.legend) {
      const entry = element("span", "entry", box);
      const mark = element("span", "mark", entry, sign.startsWith("#") ? "" : sign);
      if (sign.startsWith("#")) mark.style.background = sign;
      element("span", "", entry, text);
    }
    element("div", "", box, images.note);
  };

  const showMarks = () => {
    tiles.forEach((tile, sensor) => tile.classList.toggle("selected", sensor === marks.selected));
    for (const canvas of host.querySelectorAll("[data-zones]")) {
      const sensor = Number(canvas.dataset.zones), box = canvas.parentElement;
      box.querySelectorAll(".tofscope-zone").forEach(old => old.remove());
      for (const [name, zone] of [["pinned", marks.pinned], ["pointed", marks.pointed]]) {
        if (!zone || zone[0] !== sensor) continue;
        const [rows, columns] = layout.full[sensor], size = canvas.clientWidth / columns;
        const mark = element("div", `tofscope-zone ${name}`, box);
        mark.style.left = `${canvas.offsetLeft + zone[2] * size}px`;
        mark.style.top = `${canvas.offsetTop + zone[1] * canvas.clientHeight / rows}px`;
        mark.style.width = mark.style.height = `${size}px`;
      }
    }
  };

  // ---- what a person does

  const zoneAt = event => {
    const canvas = event.target.closest?.("[data-zones]");
    if (!canvas) return null;
    const sensor = Number(canvas.dataset.zones), [rows, columns] = layout.full[sensor];
    const box = canvas.getBoundingClientRect();
    const along = (part, count) => Math.min(Math.max(Math.floor(part * count), 0), count - 1);
    return {
      sensor,
      row: along((event.clientY - box.top) / box.height, rows),
      column: along((event.clientX - box.left) / box.width, columns),
    };
  };
  document.addEventListener("pointermove", event => {
    const zone = host && zoneAt(event);
    if (zone) tofscope.answers?.look(event, {zone});
  });
  document.addEventListener("click", event => {
    if (!host?.contains(event.target)) return;
    const zone = zoneAt(event), named = event.target.closest("[data-sensor]");
    if (zone) tofscope.tell("zone_clicked", zone);
    else if (named) tofscope.tell("sensor_clicked", {sensor: Number(named.dataset.sensor)});
  });

  // The tab's contents come and go; the session sends images only while they are seen.
  const watched = new ResizeObserver(() => show());
  const watch = () => {
    const found = document.getElementById(HOST);
    if (found !== host) {
      if (host) watched.unobserve(host);
      host = found;
      if (host) watched.observe(host);
      show();
    }
    const now = Boolean(host?.clientWidth);
    if (now !== seen) {
      seen = now;
      tofscope.tell("images_seen", {seen});
    }
  };
  setInterval(watch, 200);

  tofscope.sensors = {
    open(next) {
      layout = next;
      images = null;
      marks = {};
      seen = false;  // of this session nobody has told it yet
      let start = 0;
      layout.starts = layout.grids.map(([rows, columns]) => (start += rows * columns) - rows * columns);
      watch();
    },
    show(next) {
      images = {...next, values: bytes(next.values), moves: bytes(next.moves),
                colours: bytes(next.colours)};
      const chosen = images.selected;
      if (chosen) {
        chosen.values = bytes(chosen.values);
        chosen.moves = bytes(chosen.moves);
      }
      show();
    },
    say(text) {
      images = null;
      if (host) host.textContent = text;
    },
    mark(next) {
      marks = next;
      if (host && images && tiles.length) showMarks();
    },
  };
}
