// Rules of number fields, said beside the field while it is typed into, and what became of a number
// that does not obey them.
window.tofscope ??= {};
if (!window.tofscope.fields) {
  const rules = new Map();  // id of a control's element: {rule, whole}
  const NUMBER = "input.mantine-NumberInput-input", STAYS = 8000;  // milliseconds after it is left
  const bubble = document.createElement("div");
  bubble.id = "tofscope-rule";
  bubble.setAttribute("role", "status");
  bubble.hidden = true;
  document.body.append(bubble);

  let corrected = null, cut = null, leaving = 0;
  const owner = input => [...rules.keys()].find(
    id => document.getElementById(id)?.parentElement.contains(input));
  const focused = () => {
    const field = document.activeElement;
    return field?.matches(NUMBER) ? owner(field) : undefined;
  };

  // Beside the panel, at the height of the field; where there is no room, above the field.
  const place = id => {
    const row = document.getElementById(id)?.parentElement;
    const label = document.querySelector(`label[for="${id}"]`);
    if (!row || !label || !row.getClientRects().length) return false;
    const {left} = label.getBoundingClientRect(), {top, bottom, right} = row.getBoundingClientRect();
    const beside = left > 260, {style} = bubble;
    style.right = `${window.innerWidth - (beside ? left - 14 : right)}px`;
    style.top = beside ? `${(top + bottom) / 2}px` : `${top - 4}px`;
    style.transform = beside ? "translateY(-50%)" : "translateY(-100%)";
    return true;
  };
  const show = (id, text, kind) => {
    clearTimeout(leaving);
    bubble.textContent = text;
    bubble.className = kind;
    bubble.hidden = !place(id);
  };
  const hide = () => { bubble.hidden = true; };
  const leave = () => {
    clearTimeout(leaving);
    leaving = setTimeout(() => { corrected = null; hide(); }, STAYS);
  };

  document.addEventListener("focusin", () => {
    const id = focused();
    if (id === undefined || id === corrected) return;
    corrected = null;
    show(id, rules.get(id).rule, "");
  });
  document.addEventListener("focusout", () => {
    cut = null;
    if (corrected === null) hide(); else leave();
  });
  document.addEventListener("beforeinput", event => {
    const {target, data, inputType} = event, id = focused();
    if (id === undefined) return;
    if (inputType !== "insertText" || target.selectionStart !== target.selectionEnd) cut = null;
    if (inputType !== "insertText" || !data) return;
    const {rule, whole} = rules.get(id);
    if (whole && /[.,]/.test(data)) cut = target;
    if (cut === target) {
      event.preventDefault();  // else 1.5 would become 15
      show(id, `What follows the point is left out. ${rule}`, "corrected");
    } else if (/[^-\d.,]/.test(data)) {
      show(id, `“${data}” is left out: this takes numbers. ${rule}`, "corrected");
    }
  }, true);

  window.tofscope.fields = {
    rule: (id, rule, whole) => rules.set(id, {rule, whole}),
    // What became of a number in a control's field; an empty sentence where it is to be forgotten.
    say: (id, sentence) => {
      if (sentence) {
        corrected = id;
        show(id, sentence, "corrected");
        if (focused() !== id) leave();
      } else if (id === corrected) {
        corrected = null;
        if (focused() === id) show(id, rules.get(id).rule, ""); else hide();
      }
    },
  };
}
