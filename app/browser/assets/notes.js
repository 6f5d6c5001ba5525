// What is to be known about the open recording: whole sentences, in a card over the page.
window.tofscope ??= {};
{
  document.getElementById("tofscope-notes")?.remove();  // of before a lost connection
  const {element} = window.tofscope;
  const dialog = element("dialog", "tofscope-card", document.body);
  dialog.id = "tofscope-notes";
  element("button", "", dialog, "Close").addEventListener("click", () => dialog.close());
  const title = element("h2", "", dialog), list = element("ul", "", dialog);

  dialog.addEventListener("keydown", event => event.stopPropagation());
  dialog.addEventListener("click", event => {
    if (event.target === dialog) dialog.close();  // beside the card
  });
  // The keys are playback's again.
  dialog.addEventListener("close", () => setTimeout(() => document.activeElement?.blur()));

  window.tofscope.notes = {
    show: () => {
      if (!dialog.open) dialog.showModal();
    },
    fill: (name, sentences) => {
      title.textContent = `Notes on ${name}`;
      dialog.setAttribute("aria-label", title.textContent);
      list.replaceChildren(...sentences.map(sentence => element("li", "", null, sentence)));
    },
  };
}
