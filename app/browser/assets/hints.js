// Labels of controls say what their fields say; keys of commands are written as on a keyboard.
window.tofscope ??= {};
{
  const {tofscope} = window;
  const KEYS = {arrowleft: "←", arrowright: "→", arrowup: "↑", arrowdown: "↓", home: "Home",
    end: "End", space: "Space", pageup: "Page Up", pagedown: "Page Down", escape: "Esc"};

  tofscope.hints = {};  // {id of a control's element: hint}
  const explain = label => {
    const hint = tofscope.hints[label.htmlFor];
    if (hint) label.title = hint;
  };
  // Only what stands for keys alone: a command's own name may hold such a word.
  const rename = node => {
    if (!node.parentElement?.closest(".mantine-Spotlight-action")) return;
    const parts = node.nodeValue.split("+");
    const text = parts.map(part => KEYS[part.trim().toLowerCase()] ?? part).join("+");
    if (text !== node.nodeValue) node.nodeValue = text;
  };
  const look = root => {
    if (root.matches("label[for]")) explain(root);
    root.querySelectorAll("label[for]").forEach(explain);
    const texts = document.createTreeWalker(root, NodeFilter.SHOW_TEXT);
    while (texts.nextNode()) rename(texts.currentNode);
  };
  tofscope.showHints = hints => {
    tofscope.hints = hints;
    look(document.body);
  };
  if (!tofscope.watchesHints) {
    tofscope.watchesHints = new MutationObserver(changes => {
      for (const {type, target, addedNodes} of changes) {
        if (type === "characterData") rename(target);
        for (const node of addedNodes) {
          if (node.nodeType === Node.ELEMENT_NODE) look(node);
          if (node.nodeType === Node.TEXT_NODE) rename(node);
        }
      }
    });
    tofscope.watchesHints.observe(
      document.body, {childList: true, characterData: true, subtree: true});
  }
}
