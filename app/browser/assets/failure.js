// What could not be opened, why, and what to do: a card over the scene, until it is closed or
// another recording is opened. The recording before stays open behind it.
window.tofscope ??= {};
{
  const {tofscope} = window, {element} = tofscope, ID = "tofscope-failure";
  document.getElementById(ID)?.remove();  // of before a lost connection
  const card = element("div", "tofscope-card");
  card.id = ID;
  card.setAttribute("role", "alertdialog");
  card.setAttribute("aria-labelledby", `${ID}-title`);
  card.hidden = true;
  const title = element("h2", "", card), reason = element("p", "", card);
  const advice = element("p", "faint", card), foot = element("footer", "", card);
  title.id = `${ID}-title`;
  const close = () => { card.hidden = true; };
  const button = (text, hint, action) => {
    const made = element("button", "", foot, text);
    made.type = "button";
    made.title = hint;
    made.addEventListener("click", action);
  };
  button("Choose another", "The list of recordings (O)", () => {
    close();
    tofscope.recordings.show();
  });
  button("Close", "Esc", close);
  document.body.append(card);

  tofscope.failure = {
    show: (heading, sentence, sentences) => {
      title.textContent = heading;
      reason.textContent = sentence;
      advice.textContent = sentences;
      card.hidden = false;
      card.scrollTop = 0;
    },
    close,
  };
  if (!tofscope.failureKey) {
    tofscope.failureKey = true;
    document.addEventListener("keydown", event => {
      const shown = document.getElementById(ID);
      if (event.key !== "Escape" || shown.hidden || event.target.closest?.("dialog")) return;
      event.stopPropagation();  // what is selected in the scene stays so
      shown.hidden = true;
    }, true);
  }
}
