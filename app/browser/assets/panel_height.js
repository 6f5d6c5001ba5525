// The panel with the parameters is no higher than they are, so that the one below gets the rest;
// viser divides the height by shares alone. Whoever drags the divider decides from then on.
window.tofscope ??= {};
if (!window.tofscope.keepsHeights) {
  window.tofscope.keepsHeights = true;
  const MARGIN = 8, LEAST = 50;  // pixels; the latter is viser's own least height of a panel
  let limited = [], most = 0;  // the two panels, and the height that the first has at most
  const dragged = new WeakSet();

  const release = () => {
    for (const [index, panel] of limited.entries())
      panel.style.setProperty(index ? "min-height" : "max-height", index ? `${LEAST}px` : "");
    limited = [];
  };

  const fit = () => {
    const leaf = document.querySelector("[data-dock-leaf][data-testid=floating-panel]");
    const stack = leaf?.closest("[data-dock-scroll]");
    const parts = [...stack?.children ?? []], divider = parts[1];
    const content = leaf?.querySelector(".mantine-ScrollArea-content");
    const fits = parts.length === 3 && "dockDivider" in divider.dataset && content
      && parts[0] === leaf.parentElement && !dragged.has(stack);
    if (!fits) {
      release();
      return;
    }
    const [above, , below] = parts, around = leaf.offsetHeight - content.parentElement.offsetHeight;
    const wanted = content.offsetHeight + around + MARGIN;
    if (limited[0] === above && limited[1] === below && wanted === most) return;
    release();
    [limited, most] = [[above, below], wanted];
    above.style.maxHeight = `${wanted}px`;
    below.style.setProperty("min-height",
      `max(${LEAST}px, calc(100% - ${wanted + divider.offsetHeight}px))`, "important");
  };

  // viser drags from the share of the height, not from what is shown: it is told of a press as far
  // away as both differ, so that the divider follows the pointer.
  document.addEventListener("pointerdown", event => {
    const divider = event.target.closest("[data-dock-divider=column]");
    const stack = divider?.parentElement, [above] = limited;
    if (!event.isTrusted || !stack || above?.parentElement !== stack) return;
    event.stopImmediatePropagation();
    const share = above.style.flexGrow * (stack.offsetHeight - divider.offsetHeight);
    const {pointerId, pointerType, clientX} = event, kind = {bubbles: true, cancelable: true};
    divider.dispatchEvent(new PointerEvent("pointerdown", {...kind, pointerId, pointerType, clientX,
      clientY: event.clientY + share - above.offsetHeight, button: 0, buttons: 1, isPrimary: true}));
    const moved = () => {
      dragged.add(stack);
      release();
    };
    window.addEventListener("pointermove", moved, {once: true});
    window.addEventListener("pointerup", () => window.removeEventListener("pointermove", moved),
      {once: true});
  }, true);
  fit();
  setInterval(fit, 300);
}
