// Line and scale bar in the lower left corner of the scene.
window.tofscope ??= {};
{
  const {tofscope} = window, {element} = tofscope;

  const page = document.documentElement.style;
  const corner = document.getElementById("tofscope-corner") ?? document.createElement("div");
  corner.id = "tofscope-corner";
  corner.hidden = true;  // until there is something to say
  corner.replaceChildren();
  document.body.append(corner);
  const scale = element("div", "scale", corner);
  const bar = element("i", "bar", scale);
  const length = element("span", "length", scale);
  const line = element("div", "line", corner);

  // The legend stands above, however many lines there are.
  const lift = () => page.setProperty("--corner-height", `${corner.offsetHeight}px`);
  tofscope.cornerSize?.disconnect();
  tofscope.cornerSize = new ResizeObserver(lift);
  tofscope.cornerSize.observe(corner);

  tofscope.corner = {
    // `share` is the bar's length as a part of the scene's height.
    show({parts, text, share, dark}) {
      corner.classList.toggle("dark", dark);
      corner.hidden = parts.length === 0;
      line.replaceChildren();
      parts.forEach((part, index) => {
        if (index > 0) line.append(" ");
        const whole = element("span", "part", line);
        if (index > 0) element("span", "dot", whole, "·");
        whole.append(index > 0 ? ` ${part}` : part);
      });
      scale.hidden = text === "";
      length.textContent = text;
      bar.style.width = `calc(${share} * var(--scene-height, 100vh))`;
      lift();
    },
  };
}
