// The timeline along the bottom of the window: transport, tracks, marks.
// What the session knows is shown by `window.tofscope.timeline.*`; what a person does is told.
{
  const {tofscope} = window;
  const icon = path => `<svg viewBox="0 0 16 16" aria-hidden="true"><path d="${path}"/></svg>`;
  const icons = {
    first: icon("M2 2h2v12H2zM14 2v12L5 8z"), last: icon("M12 2h2v12h-2zM2 2v12l9-6z"),
    back: icon("M11 2v12L3 8z"), on: icon("M5 2v12l8-6z"),
    play: icon("M4 2v12l10-6z"), pause: icon("M3 2h4v12H3zM9 2h4v12H9z"),
    loop: icon("M4 3h7V1l4 3-4 3V5H5v3H3V4zM12 13H5v2l-4-3 4-3v2h6V8h2v4z"),
    mark: icon("M3 1h10v14l-5-4-5 4z"), whole: icon("M1 7h3V4l-4 4 4 4V9h8v3l4-4-4-4v3z"),
  };
  const button = (name, label, hint, content) =>
    `<button type="button" data-do="${name}" aria-label="${label}" title="${hint}">`
    + `${content}</button>`;

  const layout = `
    <div class="transport">
      ${button("first", "First frame", "First frame (Home)", icons.first)}
      ${button("back", "Previous frame", "Previous frame (J or ←; ten with Shift ←)", icons.back)}
      <button type="button" class="play" data-do="play" aria-label="Play" title="Space"></button>
      ${button("on", "Next frame", "Next frame (L or →; ten with Shift →)", icons.on)}
      ${button("last", "Last frame", "Last frame (End)", icons.last)}
      <span class="apart roomy">
        ${button("before", "Previous motion", "To where something begins to move before this "
          + "frame: by the truth, or by the estimates so far (Shift+M)", "◂ motion")}
        ${button("after", "Next motion", "To where something begins to move after this frame: by "
          + "the truth, or by the estimates so far (M)", "motion ▸")}
      </span>
      <label class="apart" title="Speed of playback, a multiple of real time (Shift+J slower, `
      + `Shift+L faster)"><span class="roomy faint">Speed </span>
        <select class="speed" aria-label="Speed"></select></label>
      ${button("loop", "Loop", "Play the range again and again (R)", icons.loop)}
      <label class="apart" title="Seconds from the start; Enter goes there">
        <input class="time" inputmode="decimal" aria-label="Go to time"> s</label>
      <span class="readout faint" role="status"></span>
      <span class="last roomy range faint"></span>
      ${button("mark", "Mark this frame", "A mark with a note at this frame, kept beside the "
        + "recording (K)", icons.mark + '<span class="roomy">Mark</span>')}
      ${button("whole", "Whole recording", "Show the whole recording (double click). Wheel: zoom; "
        + "Shift+wheel: move", icons.whole)}
    </div>
    <div class="body">
      <div class="names"></div>
      <div class="tracks" role="slider" tabindex="0" aria-label="Frame" aria-valuemin="0"
        title=""><canvas></canvas></div>
    </div>`;

  const element = document.createElement("div");
  element.id = "tofscope-timeline";
  element.className = "empty";  // until a recording is open
  element.innerHTML = layout;
  document.getElementById(element.id)?.remove();  // of a connection that was lost
  document.body.append(element);

  const find = selector => element.querySelector(selector);
  const state = {
    times: new Float32Array([0]), frame: 0, playing: false, speed: 1, loop: false,
    first: 0, last: 0, marks: [], moving: [], gaps: [], empty: [], values: null, zones: null,
    unread: 0, colours: {flow: "#080", gap: "#c60", empty: "#999"}, held: null,
  };
  const last = () => state.times.length - 1;
  const clip = frame => Math.min(Math.max(frame, 0), last());
  const tracks = tofscope.timelineTracks(find(".tracks"), state);
  const marks = tofscope.timelineMarks(element, state, tracks.place);
  const frames = tofscope.untilKnown(frame => {
    if (state.held === "playhead") return;
    state.frame = clip(frame);
    tracks.follow(state.frame);
    show();
  });
  const ranges = tofscope.untilKnown(range => {
    if (state.held === "first" || state.held === "last") return;
    Object.assign(state, range);
    show();
  });

  const seek = frame => {
    state.frame = clip(frame);
    if (!state.playing) frames.told(state.frame);
    tofscope.tellLatest("seek", {frame: state.frame});
    show();
  };

  const does = {
    first: () => seek(0), last: () => seek(last()),
    back: () => tofscope.tell("step", {frames: -1}), on: () => tofscope.tell("step", {frames: 1}),
    play: () => tofscope.tell("play", {}),
    before: () => tofscope.tell("motion", {direction: -1}),
    after: () => tofscope.tell("motion", {direction: 1}),
    loop: () => tofscope.tell("playback", {loop: !state.loop}),
    mark: () => marks.edit(state.frame), whole: () => { tracks.whole(); show(); },
  };
  element.addEventListener("click", event => {
    const pressed = event.target.closest("[data-do]");
    if (!pressed) return;
    does[pressed.dataset.do]?.();
    pressed.blur();  // a focused button would take the space bar
  });
  find(".speed").addEventListener("change", ({target}) => {
    tofscope.tell("playback", {speed: Number(target.value)});
    target.blur();
  });
  find(".time").addEventListener("keydown", event => {
    event.stopPropagation();
    if (event.key === "Escape") event.target.blur();
    if (event.key !== "Enter") return;
    const seconds = Number(event.target.value.replace(",", "."));
    if (event.target.value.trim() !== "" && Number.isFinite(seconds)) seek(tracks.nearest(seconds));
    event.target.blur();
  });
  find(".time").addEventListener("blur", () => show());

  tracks.onSeek = seek;
  tracks.onHold = held => { state.held = held; };
  tracks.onRange = range => {
    Object.assign(state, range);
    ranges.told(range);
    tofscope.tellLatest("playback", range, 60);
    show();
  };
  tracks.onMark = mark => { seek(mark.frame); marks.edit(mark.frame); };

  const keys = {ArrowLeft: -1, ArrowRight: 1, ArrowDown: -1, ArrowUp: 1, PageDown: -10, PageUp: 10};
  find(".tracks").addEventListener("keydown", event => {
    const {key, shiftKey} = event;
    if (key in keys) seek(state.frame + keys[key] * (shiftKey ? 10 : 1));
    else if (key === "Home") seek(0);
    else if (key === "End") seek(last());
    else return;
    event.preventDefault();
    event.stopPropagation();
  });

  const seconds = frame => state.times[clip(frame)].toFixed(3);
  const show = tofscope.once(() => {
    const play = find(".play"), time = find(".time"), slider = find(".tracks");
    const label = state.playing ? "Pause" : "Play";
    if (play.getAttribute("aria-label") !== label || !play.innerHTML) {
      play.setAttribute("aria-label", label);
      play.innerHTML = state.playing ? icons.pause : icons.play;
    }
    find("[data-do=loop]").setAttribute("aria-pressed", state.loop);
    find(".speed").value = String(state.speed);
    if (document.activeElement !== time) time.value = seconds(state.frame);
    find(".readout").textContent =
      `of ${seconds(last())} s · frame ${state.frame} of ${last()}`;
    const whole = state.first === 0 && state.last === last();
    find(".range").textContent = whole ? "" : `plays frames ${state.first} to ${state.last}`;
    slider.setAttribute("aria-valuemax", last());
    slider.setAttribute("aria-valuenow", state.frame);
    slider.setAttribute("aria-valuetext", `frame ${state.frame}, ${seconds(state.frame)} s`);
    tracks.draw();
  });
  new ResizeObserver(show).observe(find(".tracks"));

  const floats = text => new Float32Array(tofscope.bytes(text).buffer);
  // Frames whose bits are set: eight in a byte, the first in the highest.
  const framesOf = text => {
    const bytes = tofscope.bytes(text), found = [];
    bytes.forEach((byte, n) => {
      for (let bit = 0; bit < 8; bit++) if (byte & 128 >> bit) found.push(8 * n + bit);
    });
    return found;
  };
  // [first, last] of each run of frames.
  const stretchesOf = frames => frames.reduce((runs, frame) => {
    const run = runs[runs.length - 1];
    if (run && run[1] === frame - 1) run[1] = frame; else runs.push([frame, frame]);
    return runs;
  }, []);
  const unknown = () => new Float32Array(state.times.length).fill(NaN);

  tofscope.timeline = {
    // A newly opened recording: its frames' seconds from the start, float32 in base64.
    open: (times, speeds) => {
      Object.assign(state, {times: floats(times), values: null, zones: null, held: null});
      find(".speed").innerHTML =
        speeds.map(speed => `<option value="${speed}">${speed}x</option>`).join("");
      find(".speed").value = String(state.speed);
      element.classList.remove("empty");
      marks.close();
      frames.forget();
      ranges.forget();
      tracks.whole();
      show();
    },
    // The current frame, unless a person holds the playhead.
    frame: frame => {
      element.dataset.frame = frame;  // that is drawn; a person may be ahead of it
      frames.heard(frame);
    },
    // Speed, loop and range, this unless a person holds an end of it.
    playback: ({first, last: end, ...others}) => {
      Object.assign(state, others);
      if (state.playing) frames.forget();
      ranges.heard({first, last: end});
      show();
    },
    // What moves, where frames are missing or empty, and how many are not read yet.
    events: ({moving, gaps, empty, unread}) => {
      Object.assign(state, {moving: stretchesOf(framesOf(moving)), gaps: framesOf(gaps),
        empty: stretchesOf(framesOf(empty)), unread});
      show();
    },
    marks: list => { state.marks = list; show(); },
    colours: colours => { state.colours = colours; show(); },
    edit: frame => marks.edit(frame),
    // The plotted quantity: {title, unit, top, signed, options: [[name, title]], chosen}.
    quantity: quantity => {
      state.values = {...quantity, values: state.values?.values ?? unknown()};
      names();
      show();
    },
    // Numbers of some frames: of the quantity, and the shares of valid zones.
    numbers: (frames, values, zones) => {
      const numbers = floats(values), shares = floats(zones);
      framesOf(frames).forEach((frame, n) => {
        state.values.values[frame] = numbers[n];
        state.zones[frame] = shares[n];
      });
      show();
    },
    // Other numbers will come.
    forget: () => {
      state.values.values = unknown();
      state.zones = unknown();
      show();
    },
  };

  tofscope.atOnce.k = () => { if (!element.classList.contains("empty")) does.mark(); };

  let named = "";
  const names = () => {
    const {options, chosen, truth} = state.values;
    const wanted = JSON.stringify([options, chosen, truth]);
    if (wanted === named) return;  // a list that is open would close
    named = wanted;
    find(".names").innerHTML = tracks.rows(truth).map(({name, y, hint}) => name === "quantity"
      ? `<select aria-label="Plotted quantity" style="top: ${y}px"
           title="The quantity drawn along the timeline">${options.map(([value, title]) =>
             `<option value="${value}" ${value === chosen ? "selected" : ""}>${title}</option>`)
               .join("")}</select>`
      : `<span style="top: ${y}px" title="${hint}">${name}</span>`).join("");
    find(".names select").addEventListener("change", ({target}) => {
      tofscope.tell("strip", {name: target.value});
      target.blur();
    });
  };
  show();
}
