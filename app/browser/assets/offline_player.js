// What viser's player of an offline page lacks: it begins at a frame, says frame and time, steps by
// key, and shows on its bar where something moves.
{
  const content = JSON.parse(document.getElementById("tofscope-frames").textContent);
  const {begin, numbers, last, starts, seconds, lasting, moving, lines, legends, legend} = content;
  const STEPS = [0.1, 0.2, 0.5, 1, 2, 5, 10, 30, 60, 120, 300, 600, 1800, 3600];
  const APART = 64;  // pixels between two labels
  const JUST_AFTER = 5e-4;  // seconds after a frame's start, where it is shown in any case
  const page = document.documentElement.style;
  let bar, field, track, thumb, label, ticks, shown = -1;

  const find = () => {
    field = document.querySelector("input.mantine-NumberInput-input");
    track = document.querySelector(".mantine-Slider-root");
    thumb = track?.querySelector("[role=slider]");
    bar = track?.parentElement;
    return field && thumb && window.__viserMutable?.cameraControl;
  };

  const indexAt = time => {
    let low = 0, high = starts.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (starts[middle] <= time + 1e-4) low = middle; else high = middle - 1;
    }
    return low;
  };

  const goTo = index => {
    const to = Math.min(Math.max(index, 0), starts.length - 1);
    const time = (starts[to] + JUST_AFTER).toFixed(4);
    // React takes a value only where its own setter is passed by.
    Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, "value").set.call(field, time);
    field.dispatchEvent(new Event("input", {bubbles: true}));
  };

  const add = (parent, tag, text = "") => {
    const element = document.createElement(tag);
    element.textContent = text;
    parent.append(element);
    return element;
  };

  const said = index => {
    const {share, text} = scaleBar();
    tofscope.corner.show({parts: lines[index], text, share, dark: content.dark});
  };

  // As in the app: the longest of 1, 2 or 5 times a power of ten in a quarter of the width.
  const scaleBar = () => {
    const {camera, cameraControl} = window.__viserMutable;
    const high = 2 * cameraControl.distance * Math.tan(camera.fov * Math.PI / 360);
    const longest = 0.25 * high * camera.aspect * (1 + 1e-9);
    if (!(longest > 0 && longest < Infinity)) return {share: 0, text: ""};
    const power = 10 ** Math.floor(Math.log10(longest));
    const metres = Math.max(...[1, 2, 5].map(s => s * power).filter(m => m <= longest));
    const [factor, unit] = metres >= 1 ? [1, "m"] : metres >= 0.01 ? [100, "cm"] : [1000, "mm"];
    return {share: metres / high, text: `${Number((factor * metres).toPrecision(3))} ${unit}`};
  };

  const show = () => {
    const index = indexAt(Number(thumb.getAttribute("aria-valuenow")));
    if (index === shown) return;
    shown = index;
    label.replaceChildren();
    add(label, "span", `frame ${numbers[index]}`);
    add(label, "span", ` of ${last}`).className = "whole";
    add(label, "span", ` · ${seconds[index].toFixed(2)} s`);
    said(index);
    const words = document.getElementById("tofscope-legend");
    if (words.dataset.index !== String(legend[index])) {
      words.dataset.index = legend[index];
      words.innerHTML = legends[legend[index]];
    }
  };

  const drawTicks = () => {
    page.setProperty("--scene-bottom", `${bar.offsetHeight}px`);
    ticks.replaceChildren();
    const width = track.clientWidth, first = seconds[0];
    const strip = add(ticks, "canvas"), pen = strip.getContext("2d");
    strip.width = Math.max(width, 1);
    strip.height = 1;
    pen.fillStyle = content.colour;
    starts.forEach((start, index) => {
      const end = starts[index + 1] ?? lasting, scale = width / lasting;
      pen.globalAlpha = moving[index];
      pen.fillRect(start * scale, 0, Math.max((end - start) * scale, 1), 1);
    });
    const step = STEPS.find(s => s / lasting * width >= APART) ?? lasting;
    for (let k = Math.ceil(first / step - 1e-6); k * step < first + lasting - 1e-6; k++) {
      const tick = add(ticks, "span", `${Number((k * step).toFixed(2))} s`);
      tick.style.left = `${100 * (k * step - first) / lasting}%`;
    }
  };

  const begun = () => {
    bar.classList.add("tofscope-bar");
    bar.classList.toggle("part", seconds[0] > 0);
    label = document.createElement("span");
    label.id = "tofscope-now";
    track.before(label);
    ticks = add(track, "div");
    ticks.id = "tofscope-ticks";
    new ResizeObserver(drawTicks).observe(bar);
    new MutationObserver(show).observe(thumb, {attributeFilter: ["aria-valuenow"]});
    // A button with the focus would be pressed by the space that plays.
    bar.addEventListener("click", event => event.target.closest("button")?.blur());
    window.addEventListener("keydown", step, true);
    window.__viserMutable.cameraControl.addEventListener("update", () => said(shown));
    field.focus = () => {};  // which its own library calls after each change, to set the caret
    goTo(begin);
    drawTicks();
    show();
  };

  const step = event => {
    const to = {
      ArrowLeft: shown - 1, ArrowRight: shown + 1, Home: 0, End: starts.length - 1,
    }[event.key];
    if (to === undefined || event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.target.matches("input, textarea, select")) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    goTo(to);
  };

  const waiting = setInterval(() => {
    if (!find()) return;
    clearInterval(waiting);
    begun();
  }, 20);
}
