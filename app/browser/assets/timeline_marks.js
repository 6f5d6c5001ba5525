// Card in which a mark of the timeline gets its note.
window.tofscope ??= {};
window.tofscope.timelineMarks = (timeline, state, place) => {
  const {element, tell} = window.tofscope;
  let card = null;
  const close = () => {
    card?.remove();
    card = null;
  };

  const edit = frame => {
    close();
    const mark = state.marks.find(each => each.frame === frame);
    card = element("div", "mark-card", timeline);
    card.setAttribute("role", "dialog");
    card.setAttribute("aria-label", "Mark");
    element("div", "", card,
      `${mark ? "Mark" : "New mark"} at frame ${frame}, ${state.times[frame].toFixed(3)} s`);
    const note = element("input", "", card), buttons = element("footer", "", card);
    Object.assign(note, {maxLength: 500, placeholder: "What is there to see?"});
    note.setAttribute("aria-label", "Note");
    note.value = mark?.text ?? "";
    const save = () => {
      tell("mark", {frame, text: note.value.trim()});
      close();
    };
    const button = (label, action) => {
      const made = element("button", "", buttons, label);
      made.type = "button";
      made.addEventListener("click", action);
    };
    if (mark) button("Remove", () => { tell("unmark", {frame}); close(); });
    button("Cancel", close);
    button("Save", save);
    note.addEventListener("keydown", event => {
      event.stopPropagation();  // keys of playback are letters here
      if (event.key === "Enter") save();
      if (event.key === "Escape") close();
    });
    const {left} = timeline.querySelector(".tracks").getBoundingClientRect();
    const wanted = left + place(frame) - card.offsetWidth / 2;
    card.style.left = `${Math.max(Math.min(wanted, window.innerWidth - card.offsetWidth - 8), 8)}px`;
    note.focus();
  };
  return {edit, close};
};
