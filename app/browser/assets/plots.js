// Plots over a whole recording with one cursor: values while hovering, zoom by dragging, clicks
// that seek. The numbers live here, so that none of it asks the server.
window.tofscope ??= {};
{
  const {tofscope} = window, data = tofscope.plotData;
  const {roundUp, areaOf, drawAxes, drawPoints, fitted} = tofscope.plotDrawing;
  const DRAG = 4;  // pixels from which on a press is a drag
  const TWICE = 250;  // milliseconds within which a second click may make a double click
  const ENDS = [1, 1.5, 2, 3, 4, 5, 6, 8, 10];  // of vertical axes, times a power of ten
  const HEIGHT = 58, LABELS = 24, SQUARE = 210;  // pixels of plots in the panel
  tofscope.plots?.remove();  // those of a session before

  const made = (tag, name, parent) => {
    const element = document.createElement(tag);
    element.className = name;
    parent?.append(element);
    return element;
  };

  const root = made("div", "tofscope-plots");
  const bar = made("div", "plots-bar", root);
  const where = made("span", "plots-where", bar);
  const enlarging = made("button", "plots-enlarge", bar);
  const body = made("div", "plots-body", root);
  const list = made("div", "plots-list", body);
  const across = made("div", "plots-across", body);

  const state = {
    plots: [], shown: ["A"], colours: {}, view: null, span: null, frame: 0, hovered: null,
    enlarged: false, drawn: 0,
  };
  const view = () => state.view ?? [0, data.seconds];

  // The series of a quantity: of each side that is shown, and of what it is compared with.
  const seriesOf = ({name, reference}) => {
    const found = state.shown.map((of, index) => ({
      label: state.shown.length > 1 ? of : reference ? "estimated" : "",
      x: data.times,
      y: data.values(name, of),
      counts: data.counts(of),
      colour: state.colours[of],
      size: index ? 1.6 : reference ? 2.6 : 2.2,
      alpha: data.alpha(of),
    }));
    const [first] = state.shown;
    if (reference) found.push({
      label: "true", x: data.times, y: data.values(reference, first), counts: null,
      colour: state.colours.truth, size: 1.4, alpha: data.alpha(first),
    });
    return found;
  };

  const axisOf = (quantity, arrays, from, to) => {
    let most = 0;
    for (const array of arrays) for (let k = from; k < to; k++) {
      const size = Math.abs(array[k]);
      if (size > most) most = size;  // NaN is not
    }
    const high = quantity.top ?? roundUp(most, ENDS), margin = 0.06 * high;
    return {low: quantity.signed ? -high - margin : -margin, high: high + margin};
  };

  const listen = new AbortController();
  const on = (target, kind, act, more) =>
    target.addEventListener(kind, act, {signal: listen.signal, ...more});

  const seek = frame => tofscope.tell("plots.seek", {frame});

  const newPlot = (quantity, parent) => {
    const heading = made("div", "plot-heading", parent);
    const title = made("span", "plot-title", heading);
    const note = made("div", "plot-note", parent);
    const area = made("div", "plot-area", parent);
    const plot = {
      quantity, heading, note, area, canvas: made("canvas", "", area),
      line: made("div", "plot-line", area), hover: made("div", "plot-line hovered", area),
      span: made("div", "plot-span", area), cells: [],
    };
    title.textContent = quantity.title;
    if (quantity.unit) made("span", "plot-unit", title).textContent = ` [${quantity.unit}]`;
    area.dataset.plot = quantity.name;
    listenToDrags(plot);
    return plot;
  };

  const within = plot => areaOf(plot.area.clientWidth, plot.area.clientHeight, plot.labelled);

  const timeAt = (plot, event) => {
    const {left, width} = within(plot), [low, high] = view();
    const share = (event.clientX - plot.area.getBoundingClientRect().left - left) / width;
    return low + (high - low) * Math.min(Math.max(share, 0), 1);
  };

  let seeking = 0;
  const listenToDrags = plot => {
    let start = null, dragged = false;
    on(plot.area, "pointerdown", event => {
      if (event.button !== 0) return;
      start = event.clientX;
      dragged = false;
      plot.from = timeAt(plot, event);
      plot.area.setPointerCapture(event.pointerId);
    });
    on(plot.area, "pointermove", event => {
      const time = timeAt(plot, event);
      if (start !== null && Math.abs(event.clientX - start) > DRAG) dragged = true;
      state.span = start !== null && dragged ? [plot.from, time].sort((a, b) => a - b) : null;
      hover(data.nearest(time));
    });
    on(plot.area, "pointerup", event => {
      if (start === null) return;
      start = null;
      if (!dragged) {
        const frame = data.nearest(timeAt(plot, event));
        clearTimeout(seeking);
        // A click may be the first of a double click, where that has a meaning.
        if (state.view && event.pointerType === "mouse")
          seeking = setTimeout(() => seek(frame), TWICE);
        else seek(frame);
      } else if (state.span && data.indexOf(state.span[1]) > data.indexOf(state.span[0])) {
        zoom(state.span);
      }
      state.span = null;
      mark();
    });
    on(plot.area, "pointercancel", () => { start = state.span = null; mark(); });
    on(plot.area, "pointerleave", () => { if (start === null) hover(null); });
    on(plot.area, "dblclick", () => { clearTimeout(seeking); zoom(null); });
  };

  const zoom = span => {
    state.view = span;
    draw();
    mark();
  };

  const hover = frame => {
    state.hovered = frame;
    mark();
  };

  // Lines, selection and values: all that follows the pointer or the frame, without drawing anew.
  const mark = () => {
    const frame = state.hovered ?? state.frame, [low, high] = view();
    for (const plot of state.plots) {
      const {left, top, width, height} = within(plot);
      const place = time => left + width * (time - low) / (high - low);
      const show = (element, from, to) => {
        const [a, b] = [place(Math.max(from, low)), place(Math.min(to, high))];
        element.style.display = b < a ? "none" : "block";
        Object.assign(element.style, {left: `${a}px`, top: `${top}px`, height: `${height}px`});
        if (element === plot.span) element.style.width = `${b - a}px`;
      };
      const now = data.times[state.frame], there = data.times[state.hovered];
      show(plot.line, now, now);
      if (state.hovered === null) plot.hover.style.display = "none";
      else show(plot.hover, there, there);
      if (state.span) show(plot.span, ...state.span); else plot.span.style.display = "none";
      say(plot, frame);
    }
    const zoomed = state.view ? ` · ${low.toFixed(2)} to ${high.toFixed(2)} s` : "";
    where.textContent = `Frame ${frame} · ${data.times[frame].toFixed(3)} s${zoomed}`;
    where.title = state.view
      ? "A double click shows the whole recording." : "Drag to zoom, click to go there.";
    tofscope.plotPair.mark(state);
  };

  const say = (plot, frame) => {
    const series = seriesOf(plot.quantity);
    while (plot.cells.length > series.length) plot.cells.pop().forEach(cell => cell.remove());
    while (plot.cells.length < series.length)
      plot.cells.push(["plot-dot", "", "plot-value"].map(n => made("span", n, plot.heading)));
    series.forEach(({label, y, counts, colour}, index) => {
      const [dot, name, value] = plot.cells[index];
      dot.style.borderColor = colour;
      dot.style.background = counts !== null && counts[frame] === 0 ? "none" : colour;
      name.textContent = label;
      value.textContent = data.written(y[frame], plot.quantity);
    });
  };

  const heightOf = plot => {
    if (!state.enlarged) return HEIGHT + (plot.labelled ? LABELS : 0);
    const words = state.plots.map(one => one.heading.offsetHeight + one.note.offsetHeight);
    const taken = bar.offsetHeight + 20 + words.reduce((sum, height) => sum + height, 0);
    return Math.max((window.innerHeight - taken) / state.plots.length, HEIGHT + LABELS);
  };

  let waiting = false;
  const draw = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      if (root.clientWidth > 0) drawNow();
    });
  };

  const drawNow = () => {
    const text = getComputedStyle(root).color, [low, high] = view();
    const from = Math.max(data.indexOf(low) - 1, 0);
    const to = Math.min(data.indexOf(high) + 1, data.times.length);
    state.plots.forEach((plot, index) => {
      plot.labelled = state.enlarged || index === state.plots.length - 1;
      plot.area.style.height = `${heightOf(plot)}px`;
      const {context, width, height} = fitted(plot.canvas);
      const area = areaOf(width, height, plot.labelled), series = seriesOf(plot.quantity);
      const x = {low, high, title: "Time [s]"};
      const y = plot.y = axisOf(plot.quantity, series.map(one => one.y), from, to);
      drawAxes(context, area, x, y, {labelled: plot.labelled, text});
      drawPoints(context, area, x, y, series, from, to);
    });
    const square = state.enlarged ? Math.min(window.innerHeight - 80, across.clientWidth) : SQUARE;
    tofscope.plotPair.draw(state, {text, height: square, axisOf});
    state.drawn += 1;
    mark();
  };

  const enlarge = () => {
    state.enlarged = !state.enlarged;
    root.classList.toggle("enlarged", state.enlarged);
    enlarging.textContent = state.enlarged ? "Close (Esc)" : "Enlarge";
    place();
    draw();
  };

  // The page removes what was in a panel that is folded or moved.
  const place = () => {
    const home = state.enlarged ? document.body : document.querySelector("[data-tofscope-plots]");
    if (home && root.parentElement !== home) home.append(root);
  };
  const moved = new MutationObserver(() => { if (!root.isConnected) place(); });
  moved.observe(document.body, {childList: true, subtree: true});
  const themed = new MutationObserver(draw);  // axes have the colour of the page's text
  themed.observe(document.documentElement, {attributeFilter: ["data-mantine-color-scheme"]});
  const resized = new ResizeObserver(draw);
  resized.observe(root);
  on(window, "resize", draw);
  on(enlarging, "click", () => { enlarge(); enlarging.blur(); });
  on(document, "keydown", event => {
    if (event.key !== "Escape" || !state.enlarged) return;
    event.stopPropagation();
    enlarge();
  }, {capture: true});
  enlarging.textContent = "Enlarge";
  enlarging.title = "The plots as large as the window, each with its axes; Escape returns.";

  tofscope.plots = {
    state,
    enlarge,
    // Begins with a recording: its times, and the quantities to plot.
    open: (times, quantities) => {
      data.begin(times);
      Object.assign(state, {view: null, hovered: null, frame: 0, span: null});
      list.replaceChildren();
      state.plots = quantities.map(quantity => newPlot(quantity, list));
      place();
      draw();
    },
    // Which sides are shown, and {side or "truth": colour}.
    look: (shown, colours) => {
      Object.assign(state, {shown, colours});
      draw();
    },
    outdate: of => {
      data.outdate(of);
      draw();
    },
    add: (...numbers) => {
      data.add(...numbers);
      draw();
    },
    // Writes {name: text} below the titles of plots.
    say: notes => {
      for (const {quantity, note} of state.plots)
        note.title = note.textContent = notes[quantity.name] ?? "";
    },
    at: frame => {
      state.frame = Math.min(frame, data.times.length - 1);
      mark();
    },
    // Draws two quantities against each other, or none.
    pair: pair => {
      tofscope.plotPair.build(across, pair, {made, on, hover, seek});
      draw();
    },
    remove: () => {
      listen.abort();
      moved.disconnect();
      themed.disconnect();
      resized.disconnect();
      root.remove();
    },
  };
}
