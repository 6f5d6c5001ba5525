// Tabs of the panels are open again after a reload.
window.tofscope ??= {};
if (!window.tofscope.keepsTabs) {
  window.tofscope.keepsTabs = true;
  const KEY = "tofscope-tabs";
  const kept = () => JSON.parse(sessionStorage.getItem(KEY) ?? "[]");
  const name = tab => tab.textContent.trim();

  // Tabs of one group replace each other; those of other groups stay.
  const keep = tab => {
    const group = [...tab.closest("[role=tablist]").querySelectorAll("[role=tab]")].map(name);
    const others = kept().filter(other => !group.includes(other));
    sessionStorage.setItem(KEY, JSON.stringify([...others, name(tab)]));
  };
  // Before the press unfolds a folded panel, whose tabs appear anew.
  document.addEventListener("pointerdown", event => {
    const tab = event.target.closest("[role=tab]");
    if (tab) keep(tab);
  }, true);
  // A focused tab would take the space bar.
  document.addEventListener("click", event => {
    if (event.detail > 0) event.target.closest("[role=tab]")?.blur();
  });
  document.addEventListener("keyup", event => {
    const tab = event.target.closest?.("[role=tab][aria-selected=true]");
    if (tab) keep(tab);
  });

  // A group appears with its first tab in front, once for each connection; its further tabs follow
  // one by one, on a busy machine seconds later. Folded panels have no strip and stay folded.
  const settled = new WeakSet();
  new MutationObserver(() => {
    for (const list of document.querySelectorAll("[role=tablist][data-dock-strip]")) {
      if (settled.has(list)) continue;
      const open = [...list.querySelectorAll("[role=tab]")]
        .find(tab => kept().includes(name(tab)));
      if (!open) continue;
      settled.add(list);
      // Tabs heed keys and presses; a click() is neither.
      if (open.getAttribute("aria-selected") === "false")
        open.dispatchEvent(new KeyboardEvent("keydown", {key: "Enter", bubbles: true}));
    }
  }).observe(document.body, {childList: true, subtree: true});
}
