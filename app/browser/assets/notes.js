// What is to be known about the open recording: whole sentences, in a card over the page.
window.tofscope ??= {};
{
  document.getElementById("tofscope-notes")?.remove();  // of before a lost connection
  const dialog = document.createElement("dialog");
  dialog.id = "tofscope-notes";
  dialog.className = "tofscope-card";
  const title = document.createElement("h2"), list = document.createElement("ul");
  const close = document.createElement("button");
  close.textContent = "Close";
  close.addEventListener("click", () => dialog.close());
  dialog.append(close, title, list);
  document.body.append(dialog);

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
      list.replaceChildren(...sentences.map(sentence => {
        const item = document.createElement("li");
        item.textContent = sentence;
        return item;
      }));
    },
  };
}
