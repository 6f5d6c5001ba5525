// Line and scale bar in the lower left corner of the scene.
window.tofscope ??= {};
{
  const add = (parent, tag, name) => {
    const element = document.createElement(tag);
    element.className = name;
    parent.append(element);
    return element;
  };

  const page = document.documentElement.style;
  const corner = document.getElementById("tofscope-corner") ?? document.createElement("div");
  corner.id = "tofscope-corner";
  corner.hidden = true;  // until there is something to say
  corner.replaceChildren();
  document.body.append(corner);
  const scale = add(corner, "div", "scale");
  const bar = add(scale, "i", "bar");
  const length = add(scale, "span", "length");
  const line = add(corner, "div", "line");

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
        if (index > 0) line.append(" · ");
        add(line, "span", "part").textContent = part;
      });
      scale.hidden = text === "";
      length.textContent = text;
      bar.style.width = `calc(${share} * var(--scene-height, 100vh))`;
      lift();
    },
  };
}
