// Line and scale bar in the lower left corner of the scene.
window.tofscope ??= {};
{
  const {tofscope} = window, {element} = tofscope;

  const corner = tofscope.overlay("tofscope-corner");
  corner.hidden = true;  // until there is something to say
  corner.replaceChildren();
  const scale = element("div", "scale", corner);
  const bar = element("i", "bar", scale);
  const length = element("span", "length", scale);
  const line = element("div", "line", corner);

  // What stays the same is left alone, since a change has the page laid out anew.
  let written = [];
  const write = parts => {
    if (parts.length !== written.length) {
      line.replaceChildren();
      parts.forEach((_, index) => {
        if (index > 0) line.append(" ");
        const whole = element("span", "part", line);
        if (index > 0) element("span", "dot", whole, "·");
        whole.append("");
      });
      written = [];
    }
    parts.forEach((part, index) => {
      if (part !== written[index]) line.children[index].lastChild.data = index > 0 ? ` ${part}` : part;
    });
    written = parts;
  };

  // The legend stands above, however many lines there are.
  tofscope.cornerSize?.disconnect();
  tofscope.cornerSize = tofscope.watchHeight(corner, "--corner-height");

  tofscope.corner = {
    // `share` is the bar's length as a part of the scene's height.
    show({parts, text, share, dark}) {
      corner.classList.toggle("dark", dark);
      corner.hidden = parts.length === 0;
      write(parts);
      scale.hidden = text === "";
      if (length.textContent !== text) length.textContent = text;
      bar.style.width = `calc(${share} * var(--scene-height, 100vh))`;
    },
  };
}
