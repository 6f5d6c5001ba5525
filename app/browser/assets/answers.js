// What is known of the point or zone under the pointer, beside it; and of the pinned one, in a card.
window.tofscope ??= {};
if (!window.tofscope.answers) {
  const {tofscope} = window, {element} = tofscope;

  const tip = element("div", "tofscope-answer tofscope-tip", document.body);
  const card = element("div", "tofscope-answer tofscope-pinned", document.body);
  tip.hidden = card.hidden = true;
  // The half of the scene that was clicked on last, also after a reload.
  let clickedRight = sessionStorage.getItem("tofscope-clicked") === "right";
  let pointer = null;  // where it is while something may answer there, else null

  const fill = (box, {title, rows}) => {
    box.replaceChildren();
    element("div", "tofscope-answer-title", box, title);
    const table = element("dl", "tofscope-answer-rows", box);
    for (const [name, value, colour] of rows) {
      element("dt", "", table, name);
      const cell = element("dd", "", table, value);
      if (colour) {
        const dot = element("span", "tofscope-answer-dot", cell);
        dot.style.background = colour;
        cell.prepend(dot);
      }
    }
  };

  const place = () => {
    const {width, height} = tip.getBoundingClientRect();
    const beside = (at, size, room) => at + 16 + size < room ? at + 16 : Math.max(at - 16 - size, 0);
    tip.style.left = `${beside(pointer.x, width, window.innerWidth)}px`;
    tip.style.top = `${beside(pointer.y, height, window.innerHeight)}px`;
  };

  // Looks at a zone or along a ray where the pointer is, or at nothing.
  const look = (event, at) => {
    if (!at && !pointer) return;
    pointer = at && {x: event.clientX, y: event.clientY};
    if (!at) tip.hidden = true;
    else if (!tip.hidden) place();
    tofscope.tellLatest("pointed", at ?? {}, 50);
  };

  // Ray through the pointer in viser's own world, which is turned against that of three.js.
  const rayAt = ({clientX, clientY}) => {
    const {camera, canvas} = window.__viserMutable;
    const {left, top, width, height} = canvas.getBoundingClientRect();
    const [w, x, y, z] = window.__viserSceneTree.getState()[""]?.wxyz ?? [1, 0, 0, 0];
    const turn = camera.quaternion.clone().set(x, y, z, w).invert();
    const origin = camera.position.clone();
    const across = 2 * (clientX - left) / width - 1, up = 1 - 2 * (clientY - top) / height;
    const direction = origin.clone().set(across, up, 0.5).unproject(camera).sub(origin).normalize();
    return {
      origin: origin.applyQuaternion(turn).toArray(),
      direction: direction.applyQuaternion(turn).toArray(),
    };
  };

  document.addEventListener("pointermove", event => {
    const {canvas, camera} = window.__viserMutable ?? {};
    const inScene = camera && event.target === canvas;
    if (inScene && event.buttons === 0) look(event, {ray: rayAt(event)});
    else if (!event.target.closest?.("[data-zones]")) look(event, null);
  });
  document.addEventListener("pointerdown", event => {
    look(event, null);
    if (event.target !== window.__viserMutable?.canvas) return;
    const {left, width} = event.target.getBoundingClientRect();
    clickedRight = event.clientX > left + width / 2;
    sessionStorage.setItem("tofscope-clicked", clickedRight ? "right" : "left");
  });
  document.documentElement.addEventListener("pointerleave", event => look(event, null));

  tofscope.answers = {
    look,
    point(answer) {
      tip.hidden = !answer || !pointer;
      if (tip.hidden) return;
      fill(tip, answer);
      place();
    },
    pin(answer) {
      card.hidden = !answer;
      if (card.hidden) {
        card.replaceChildren();
        return;
      }
      card.classList.toggle("left", clickedRight);
      fill(card, answer);
      // HTML of ours: why its cluster moves or does not.
      if (answer.story) element("div", "tofscope-answer-story", card).innerHTML = answer.story;
      const buttons = element("div", "tofscope-answer-buttons", card);
      const view = element("button", "tofscope-small", buttons, "From this sensor");
      view.addEventListener("click", () => tofscope.tell("look_from_sensor", {}));
      const close = element("button", "tofscope-small", buttons, "Let go");
      close.addEventListener("click", () => tofscope.tell("let_go", {}));
    },
  };
}
// A new session has nothing pinned, whatever the one before the connection was lost had.
window.tofscope.answers.point(null);
window.tofscope.answers.pin(null);
