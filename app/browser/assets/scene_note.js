// Why nothing is seen to move, above the legend, and what may be done about it.
window.tofscope ??= {};
{
  const {tofscope} = window, {element} = tofscope;
  const note = tofscope.overlay("tofscope-note");
  note.hidden = true;

  tofscope.note = {
    // `actions` are [text, hint, kind of event, its data].
    show({text, actions}) {
      note.hidden = !text;
      note.textContent = text;
      const buttons = element("div", "buttons", note);
      for (const [label, hint, kind, data] of actions) {
        const button = element("button", "tofscope-small", buttons, label);
        button.title = hint;
        button.addEventListener("click", () => tofscope.tell(kind, data));
      }
    },
  };
}
