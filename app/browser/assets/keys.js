// Keys that open something in the page at once: what is typed next belongs to what they open, and
// would be playback's until the session has answered.
window.tofscope ??= {};
if (!window.tofscope.atOnce) {
  window.tofscope.atOnce = {};  // {key: what it does}
  document.addEventListener("keydown", event => {
    const action = window.tofscope.atOnce[event.key.toLowerCase()];
    if (!action || event.ctrlKey || event.metaKey || event.altKey || event.shiftKey) return;
    if (event.target.closest?.("input, textarea, select, dialog")) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    if (!event.repeat) action();
  }, true);
}
