// Plots over a whole recording with one cursor: values while hovering, zoom by dragging, clicks
// that seek. The numbers live here, so that none of it asks the server.
window.tofscope ??= {};
{
  const {tofscope} = window, {element: made, once, plotData: data} = tofscope;
  const {roundUp, areaOf, drawAxes, drawPoints, fitted} = tofscope.plotDrawing;
  const ENDS = [1, 1.5, 2, 3, 4, 5, 6, 8, 10];  // of vertical axes, times a power of ten
  const HEIGHT = 58, LABELS = 28, PAIR = 230;  // pixels of plots in the panel
  const LARGER = 1.5;  // points of enlarged plots
  tofscope.plots?.remove();  // those of a session before

  const root = made("div", "tofscope-plots");
  const bar = made("div", "plots-bar", root);
  const where = made("span", "plots-where", bar);
  const about = made("span", "plots-about", bar);
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
      // Of two sides the second is drawn within the first, which stays seen where they agree.
      size: (state.shown.length > 1 ? [3, 1.5][index] : reference ? 2.6 : 2.2)
        * (state.enlarged ? LARGER : 1),
      alpha: data.alpha(of),
      joined: true,
    }));
    const [first] = state.shown;
    if (reference) found.push({
      label: "true", x: data.times, y: data.values(reference, first), counts: null,
      colour: state.colours.truth, size: 1.4, alpha: data.alpha(first), joined: true,
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
    const title = made("span", "plot-title", heading, quantity.title);
    const values = made("span", "plot-values", heading);
    const note = made("span", "plot-note", heading);
    const area = made("div", "plot-area", parent);
    const plot = {
      quantity, heading, values, note, area, within: areaOf(1, 1, false), canvas: made("canvas", "", area),
      line: made("div", "plot-line", area), hover: made("div", "plot-line hovered", area),
      span: made("div", "plot-span", area), cells: [],
    };
    if (quantity.unit) made("span", "plot-unit", title, ` [${quantity.unit}]`);
    area.dataset.plot = quantity.name;
    listenToPointer(plot);
    return plot;
  };

  const timeAt = (plot, event) => {
    const {left, width} = plot.within, [low, high] = view();
    const share = (event.clientX - plot.area.getBoundingClientRect().left - left) / width;
    return low + (high - low) * Math.min(Math.max(share, 0), 1);
  };

  const listenToPointer = plot => tofscope.plotPointer.listen(plot.area, {
    on,
    timeAt: event => timeAt(plot, event),
    zoomed: () => state.view !== null,
    hover: time => hover(time === null ? null : data.nearest(time)),
    seek: time => seek(data.nearest(time)),
    select: span => {
      state.span = span;
      mark();
    },
    zoom: span => {
      if (span && data.indexOf(span[1]) <= data.indexOf(span[0])) return;  // shows no frame
      state.view = span;
      draw();
    },
  });

  const hover = frame => {
    state.hovered = frame;
    mark();
  };

  // Lines, selection and values: all that follows the pointer or the frame, without drawing anew.
  // Nothing is measured here, since each change of a style would have the page laid out anew.
  const markNow = () => {
    const frame = state.hovered ?? state.frame, [low, high] = view();
    for (const plot of state.plots) {
      const {left, top, width, height} = plot.within;
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
      if (state.enlarged) sayBeside(plot, place(data.times[frame]), left + width);
    }
    const zoomed = state.view ? ` · ${low.toFixed(2)} to ${high.toFixed(2)} s` : "";
    where.textContent = `Frame ${frame} · ${data.times[frame].toFixed(3)} s${zoomed}`;
    where.title = state.view
      ? "A double click shows the whole recording." : "Drag to zoom, click to go there.";
    tofscope.plotPair.mark(state, frame);
  };
  const mark = once(markNow);

  // The values of an enlarged plot stand beside the cursor, on the side that has more room.
  const sayBeside = ({values}, at, end) => {
    const before = at > end / 2;
    values.style.left = before ? "" : `${at + 8}px`;
    values.style.right = before ? `calc(100% - ${at - 8}px)` : "";
  };

  const say = (plot, frame) => {
    const series = seriesOf(plot.quantity);
    while (plot.cells.length > series.length) plot.cells.pop().forEach(cell => cell.remove());
    while (plot.cells.length < series.length)
      plot.cells.push(["plot-dot", "", "plot-value"].map(n => made("span", n, plot.values)));
    series.forEach(({label, y, counts, colour}, index) => {
      const [dot, name, value] = plot.cells[index];
      dot.style.borderColor = colour;
      dot.style.background = counts !== null && counts[frame] === 0 ? "none" : colour;
      name.textContent = label;
      value.textContent = data.written(y[frame], plot.quantity);
    });
  };

  const heightOf = plot => {
    const labels = plot.labelled ? LABELS : 0;
    if (!state.enlarged) return HEIGHT + labels;
    const words = state.plots.reduce((sum, {heading}) => sum + heading.offsetHeight, 0);
    const room = (roomForPlots() - words - LABELS) / state.plots.length;
    return Math.max(room, HEIGHT) + labels;
  };
  const roomForPlots = () => window.innerHeight - bar.offsetHeight - 24;

  const drawNow = () => {
    if (root.clientWidth === 0) return;
    const text = getComputedStyle(root).color, [low, high] = view(), large = state.enlarged;
    const from = Math.max(data.indexOf(low) - 1, 0);
    const to = Math.min(data.indexOf(high) + 1, data.times.length);
    const last = state.plots.length - 1;
    state.plots.forEach((plot, index) => { plot.labelled = index === last; });
    const heights = state.plots.map(heightOf);
    state.plots.forEach((plot, index) => { plot.area.style.height = `${heights[index]}px`; });
    for (const plot of state.plots) {
      const {context, width, height} = fitted(plot.canvas);
      const series = seriesOf(plot.quantity);
      const x = {low, high, title: "Time [s]"};
      const y = axisOf(plot.quantity, series.map(one => one.y), from, to);
      plot.within = areaOf(width, height, plot.labelled);
      drawAxes(context, plot.within, x, y, {labelled: plot.labelled, text, large});
      drawPoints(context, plot.within, x, y, series, from, to);
    }
    const pair = {text, large, height: large ? roomForPlots() : PAIR, axisOf, from, to};
    tofscope.plotPair.draw(state, pair);
    state.drawn += 1;
    markNow();
  };
  const draw = once(drawNow);

  const enlarge = () => {
    state.enlarged = !state.enlarged;
    root.classList.toggle("enlarged", state.enlarged);
    for (const {area, heading, note, values} of state.plots) {
      if (state.enlarged) area.append(values); else heading.insertBefore(values, note);
    }
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
      if (state.enlarged) for (const {area, values} of state.plots) area.append(values);
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
    // Writes {name: text} below the titles of plots, and a sentence above enlarged ones.
    say: (notes, sentence) => {
      about.title = about.textContent = sentence;
      for (const {quantity, note} of state.plots)
        note.title = note.textContent = notes[quantity.name] ?? "";
    },
    at: frame => {
      state.frame = Math.min(frame, data.times.length - 1);
      mark();
    },
    // Draws two quantities against each other, or none.
    pair: pair => {
      tofscope.plotPair.build(across, pair, {on, hover, seek});
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
