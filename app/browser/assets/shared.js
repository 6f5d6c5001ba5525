// What several of our scripts need: elements of the page, and numbers as the session sends them.
window.tofscope ??= {};
{
  const {tofscope} = window;

  // Makes an element of a class, as the last one within `parent` if there is one.
  tofscope.element = (tag, name, parent = null, text = "") => {
    const made = document.createElement(tag);
    made.className = name;
    made.textContent = text;
    parent?.append(made);
    return made;
  };

  // Bytes of a text in base64; a typed array over their `buffer` reads other numbers.
  tofscope.bytes = text => Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
}
