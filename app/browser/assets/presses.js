// Tells when a slider is pressed and released: what is changed in between is one change.
window.tofscope ??= {};
if (!window.tofscope.tellsPresses) {
  window.tofscope.tellsPresses = true;
  let held = false;
  const tell = now => {
    if (held === now) return;
    held = now;
    window.tofscope.tell("slider", {held});
  };
  document.addEventListener("pointerdown", event => {
    if (event.target.closest(".mantine-Slider-root")) tell(true);
  }, true);
  for (const kind of ["pointerup", "pointercancel", "blur"])
    window.addEventListener(kind, () => tell(false), true);
}
