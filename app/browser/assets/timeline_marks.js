// Card in which a mark of the timeline gets its note.
window.tofscope ??= {};
window.tofscope.timelineMarks = (element, state, place) => {
  let card = null;
  const close = () => {
    card?.remove();
    card = null;
  };

  const edit = frame => {
    close();
    const mark = state.marks.find(each => each.frame === frame);
    card = document.createElement("div");
    card.className = "mark-card";
    card.setAttribute("role", "dialog");
    card.setAttribute("aria-label", "Mark");
    card.innerHTML = `<div></div><input maxlength="500" aria-label="Note"
      placeholder="What is there to see?"><footer></footer>`;
    card.firstChild.textContent =
      `${mark ? "Mark" : "New mark"} at frame ${frame}, ${state.times[frame].toFixed(3)} s`;
    const note = card.querySelector("input");
    note.value = mark?.text ?? "";
    const save = () => {
      window.tofscope.tell("mark", {frame, text: note.value.trim()});
      close();
    };
    const button = (label, action) => {
      const made = document.createElement("button");
      made.type = "button";
      made.textContent = label;
      made.addEventListener("click", action);
      card.querySelector("footer").append(made);
    };
    if (mark) button("Remove", () => { window.tofscope.tell("unmark", {frame}); close(); });
    button("Cancel", close);
    button("Save", save);
    note.addEventListener("keydown", event => {
      event.stopPropagation();  // keys of playback are letters here
      if (event.key === "Enter") save();
      if (event.key === "Escape") close();
    });
    element.append(card);
    const {left} = element.querySelector(".tracks").getBoundingClientRect();
    const wanted = left + place(frame) - card.offsetWidth / 2;
    card.style.left = `${Math.max(Math.min(wanted, window.innerWidth - card.offsetWidth - 8), 8)}px`;
    note.focus();
  };
  return {edit, close};
};
