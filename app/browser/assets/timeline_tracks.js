// Tracks of the timeline: time, motion, valid zones, a quantity; zoom, range and playhead.
window.tofscope ??= {};
window.tofscope.timelineTracks = (box, state) => {
  const canvas = box.querySelector("canvas"), pen = canvas.getContext("2d");
  const RULER = 15, MOTION = [18, 8], ZONES = [31, 5], STRIP = [40, 24];  // top, height in px
  const GRIP = 7;  // px
  const DENSE = 4;  // px for each stretch of motion, below which its share is drawn
  const view = {start: 0, end: 1};  // seconds
  const tracks = {onSeek: () => {}, onHold: () => {}, onRange: () => {}, onMark: () => {}};

  const duration = () => Math.max(state.times[state.times.length - 1], 1e-3);
  let measured = 1;  // once a picture, which asks for it for each frame
  const width = () => measured;
  const x = seconds => (seconds - view.start) / (view.end - view.start) * width();
  const at = frame => {  // `frame` may lie between two frames
    const {times} = state, place = Math.min(Math.max(frame, 0), times.length - 1);
    const before = Math.floor(place), part = place - before;
    return x(part ? (1 - part) * times[before] + part * times[before + 1] : times[before]);
  };
  tracks.place = at;  // of a frame, in px from the left
  const secondsAt = px => view.start + px / width() * (view.end - view.start);

  tracks.nearest = seconds => window.tofscope.nearest(state.times, seconds);

  const look = (start, span) => {
    const whole = duration(), length = Math.min(span, whole);
    view.start = Math.min(Math.max(start, 0), whole - length);
    view.end = view.start + length;
  };
  tracks.whole = () => look(0, duration());
  tracks.follow = frame => {  // a playhead that leaves the view takes it along
    const seconds = state.times[frame], span = view.end - view.start;
    if (seconds < view.start || seconds > view.end) look(seconds - 0.1 * span, span);
  };
  tracks.rows = truth => [
    {name: truth ? "true motion" : "motion", y: MOTION[0] - 4, hint: "Where something moves, "
      + (truth ? "by the truth" : "by the estimates so far")
      + ". Marked too: frames without points, and gaps where frames are missing"},
    {name: "valid zones", y: ZONES[0] - 3, hint: "Share of the zones that have a valid distance"},
    {name: "quantity", y: STRIP[0] + 4},
  ];

  const bar = (first, final, [top, height], colour, least = 3) => {
    const left = at(first), right = at(final), wide = Math.max(right - left, least);
    if (right < -least || left > width() + least) return;
    pen.fillStyle = colour;
    pen.fillRect(right - left < least ? (left + right - wide) / 2 : left, top, wide, height);
  };

  // Many stretches: each pixel column as dense as the share of it that they cover.
  const shares = (stretches, [top, height], colour) => {
    pen.fillStyle = colour;
    const spans = stretches.map(([first, final]) => [at(first), at(final + 1)]);
    window.tofscope.covered(spans, Math.ceil(width())).forEach((share, column) => {
      pen.globalAlpha = share;
      pen.fillRect(column, top, 1, height);
    });
    pen.globalAlpha = 1;
  };

  const STEPS = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60,
    120, 300, 600, 900, 1800, 3600, 7200, 14400, 36000, 86400];
  const clock = (seconds, step) => {
    if (step < 1) return seconds.toFixed(step < 0.01 ? 3 : step < 0.1 ? 2 : 1);
    const whole = Math.round(seconds), two = number => String(number).padStart(2, "0");
    if (duration() < 120) return String(whole);
    const rest = `${two(Math.floor(whole / 60) % 60)}:${two(whole % 60)}`;
    return duration() < 3600 ? rest : `${Math.floor(whole / 3600)}:${rest}`;
  };

  const ruler = ink => {
    const span = view.end - view.start;
    const step = STEPS.find(each => each / span * width() >= 56) ?? 86400;
    pen.fillStyle = ink;
    pen.font = "10px system-ui, sans-serif";
    pen.textBaseline = "top";
    for (let n = Math.ceil(view.start / step - 1e-9); n * step <= view.end + 1e-9; n++) {
      const left = x(n * step), text = clock(n * step, step);
      pen.globalAlpha = 0.3;
      pen.fillRect(left, 11, 1, 4);
      pen.globalAlpha = 0.7;
      const half = pen.measureText(text).width / 2;
      if (Math.abs(left - at(state.frame)) < half + 7) continue;  // below the playhead
      pen.fillText(text, Math.min(Math.max(left - half, 0), width() - 2 * half), 0);
    }
    pen.globalAlpha = 1;
  };

  // The visible frames, one per pixel column at least: several frames of a column are one.
  const columns = draw => {
    const from = Math.max(tracks.nearest(view.start) - 1, 0);
    const to = Math.min(tracks.nearest(view.end) + 1, state.times.length - 1);
    for (let k = from; k <= to;) {
      const left = Math.floor(at(k));
      let next = k + 1;
      while (next <= to && Math.floor(at(next)) === left) next++;
      draw(k, next, at(k), Math.max(at(Math.min(next, to)) - at(k), 1));
      k = next;
    }
  };

  const zones = () => columns((k, next, left, wide) => {
    let share = Infinity;
    for (let i = k; i < next; i++) if (state.zones[i] < share) share = state.zones[i];
    if (!Number.isFinite(share)) return;
    pen.globalAlpha = 0.06 + 0.4 * share;
    pen.fillRect(left, ZONES[0], wide + 0.5, ZONES[1]);
  });

  const strip = () => {
    const {values, top, signed} = state.values, [upper, height] = STRIP;
    const zero = signed ? upper + height / 2 : upper + height;
    const scale = (signed ? height / 2 : height) / (top || 1);
    columns((k, next, left) => {
      let low = Infinity, high = -Infinity;
      for (let i = k; i < next; i++) {
        if (Number.isNaN(values[i])) continue;
        low = Math.min(low, values[i]);
        high = Math.max(high, values[i]);
      }
      if (high < low) return;
      const y = value => Math.min(Math.max(zero - value * scale, upper), upper + height - 2);
      pen.globalAlpha = 0.22;
      pen.fillRect(left - 0.5, Math.min(y(high), zero), 1, Math.abs(zero - y(high)));
      pen.globalAlpha = 1;
      pen.fillRect(left - 1.5, y(high) - 1, 3, Math.max(y(low) - y(high), 3));
    });
  };

  tracks.draw = () => {
    measured = Math.max(box.clientWidth, 1);
    const ratio = window.devicePixelRatio || 1, wide = width(), high = box.clientHeight;
    const pixels = [Math.round(wide * ratio), Math.round(high * ratio)];
    if (canvas.width !== pixels[0] || canvas.height !== pixels[1])
      [canvas.width, canvas.height] = pixels;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, wide, high);
    const ink = getComputedStyle(box).color, {colours} = state;
    ruler(ink);
    pen.fillStyle = ink;
    pen.globalAlpha = 0.08;
    const unread = state.unread ? wide - at(state.times.length - state.unread) : 0;
    pen.fillRect(0, MOTION[0], wide - unread, MOTION[1]);
    pen.fillRect(0, STRIP[0], wide, STRIP[1]);
    pen.globalAlpha = 1;
    if (state.moving.length > wide / DENSE) shares(state.moving, MOTION, colours.flow);
    else for (const [first, final] of state.moving) bar(first, final, MOTION, colours.flow);
    for (const [first, final] of state.empty) bar(first, final, MOTION, colours.empty);
    for (const k of state.gaps) bar(k - 0.5, k - 0.5, [MOTION[0] - 2, 11], colours.gap, 2);
    pen.fillStyle = ink;
    if (state.zones) zones();
    pen.fillStyle = colours.flow;
    if (state.values) strip();
    range(ink, wide, high);
    pen.globalAlpha = 1;
    playhead(at(state.frame), ink, high);
    for (const mark of state.marks) flag(at(mark.frame), colours.mark);
    scrollbar(ink, wide, high);
  };

  const range = (ink, wide, high) => {
    const left = at(state.first), right = at(state.last);
    pen.fillStyle = ink;
    pen.globalAlpha = 0.1;
    if (state.first > 0) pen.fillRect(0, RULER, left, high);
    if (state.last < state.times.length - 1) pen.fillRect(right, RULER, wide - right, high);
    pen.globalAlpha = 0.8;
    for (const [edge, side] of [[left, 1], [right, -1]]) {  // brackets open towards the range
      pen.fillRect(edge - 1, RULER - 3, 2, 13);
      pen.fillRect(side > 0 ? edge : edge - GRIP, RULER - 3, GRIP, 2);
    }
  };

  const flag = (left, colour) => {
    pen.fillStyle = colour;
    pen.fillRect(left - 0.5, 0, 1, STRIP[0] + STRIP[1]);
    pen.beginPath();
    pen.moveTo(left, 0);
    pen.lineTo(left + 11, 4.5);
    pen.lineTo(left, 9);
    pen.fill();
  };

  const playhead = (left, ink, high) => {
    pen.fillStyle = ink;
    pen.fillRect(left - 0.75, 4, 1.5, high);
    pen.beginPath();
    pen.moveTo(left - 5, 4);
    pen.lineTo(left + 5, 4);
    pen.lineTo(left, 11);
    pen.fill();
  };

  const scrollbar = (ink, wide, high) => {
    const whole = duration();
    if (view.end - view.start > 0.999 * whole) return;
    pen.fillStyle = ink;
    pen.globalAlpha = 0.15;
    pen.fillRect(0, high - 3, wide, 3);
    pen.globalAlpha = 0.6;
    pen.fillRect(view.start / whole * wide, high - 3, (view.end - view.start) / whole * wide, 3);
    pen.globalAlpha = 1;
  };

  // What a press at a place takes hold of.
  const grip = (px, y) => {
    const near = frame => Math.abs(px - at(frame)) <= GRIP;
    if (y >= box.clientHeight - 4 && view.end - view.start < 0.999 * duration()) return "scroll";
    if (y < RULER) {
      const mark = state.marks.find(({frame}) => px >= at(frame) - 2 && px <= at(frame) + 10);
      if (mark && y < 9) return mark;
    }
    if (y >= RULER - 4 && y < RULER + 10 && state.times.length > 1) {
      // At one end both handles may lie together: the one that can move is taken.
      if (near(state.last) && (state.last > state.first || state.first > 0)
          && (!near(state.first) || state.first === state.last || px >= at(state.last)))
        return "last";
      if (near(state.first)) return "first";
    }
    return "playhead";
  };

  const move = (held, event, before) => {
    const px = event.clientX - box.getBoundingClientRect().left;
    const frame = tracks.nearest(secondsAt(Math.min(Math.max(px, 0), width())));
    if (held === "playhead") tracks.onSeek(frame);
    if (held === "first")
      tracks.onRange({first: Math.min(frame, state.last), last: state.last});
    if (held === "last")
      tracks.onRange({first: state.first, last: Math.max(frame, state.first)});
    if (held === "scroll" || held === "pan") {
      const span = view.end - view.start, sign = held === "pan" ? -span : duration();
      look(before.start + (px - before.px) / width() * sign, span);
      tracks.draw();
    }
  };

  box.addEventListener("pointerdown", event => {
    const {left, top} = box.getBoundingClientRect();
    const px = event.clientX - left;
    const held = event.button === 1 ? "pan" : event.button === 0 ? grip(px, event.clientY - top)
      : null;
    if (held === null) return;
    event.preventDefault();
    if (typeof held === "object") {
      tracks.onMark(held);
      return;
    }
    const before = {px, start: view.start};
    box.setPointerCapture(event.pointerId);
    tracks.onHold(held);
    const dragged = each => move(held, each, before);
    const released = () => {
      tracks.onHold(null);
      for (const [kind, action] of listeners) box.removeEventListener(kind, action);
    };
    const listeners = [["pointermove", dragged], ["pointerup", released],
      ["pointercancel", released]];
    for (const [kind, action] of listeners) box.addEventListener(kind, action);
    if (held === "playhead") dragged(event);
  });
  box.addEventListener("pointermove", event => {
    const {left, top} = box.getBoundingClientRect();
    const px = event.clientX - left, over = grip(px, event.clientY - top);
    const ends = over === "first" || over === "last";
    box.style.cursor = ends ? "ew-resize" : "pointer";
    box.title = typeof over === "object" ? over.text || "A mark without a note"
      : ends ? "End of the range that is played; drag it" : tip(tracks.nearest(secondsAt(px)));
  });
  const tip = frame => {
    const {values, zones: shares} = state;
    const value = values?.values[frame];
    const known = value !== undefined && !Number.isNaN(value);
    const within = stretches => stretches.some(([first, end]) => first <= frame && frame <= end);
    return [`frame ${frame}, ${state.times[frame].toFixed(3)} s`,
      ...(within(state.moving) ? ["something moves"] : []),
      ...(frame >= state.times.length - state.unread ? ["its truth is not read yet"] : []),
      ...(within(state.empty) ? ["no points"] : []),
      ...(state.gaps.includes(frame) ? ["frames are missing before this one"] : []),
      ...(known ? [`${values.title}: ${Number(value.toPrecision(4))} ${values.unit}`] : []),
      ...(Number.isFinite(shares?.[frame])
        ? [`valid zones: ${Math.round(100 * shares[frame])} %`] : []),
      ...state.marks.filter(mark => mark.frame === frame).map(mark => mark.text)].join("\n");
  };
  box.addEventListener("dblclick", () => { tracks.whole(); tracks.draw(); });
  box.addEventListener("wheel", event => {
    event.preventDefault();
    const span = view.end - view.start, sideways = event.shiftKey || event.deltaX !== 0;
    if (sideways) {
      look(view.start + (event.deltaX || event.deltaY) / width() * span, span);
    } else {
      const px = event.clientX - box.getBoundingClientRect().left, fixed = secondsAt(px);
      const shortest = Math.min(duration(), 10 * duration() / Math.max(state.times.length - 1, 1));
      const longer = Math.max(span * Math.exp(0.0015 * event.deltaY), shortest);
      look(fixed - px / width() * longer, longer);
    }
    tracks.draw();
  }, {passive: false});
  return tracks;
};
