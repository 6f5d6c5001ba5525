// The list of recordings, over the page: search by any part of the name, see what is in each,
// choose one.
window.tofscope ??= {};
{
  const {tofscope} = window, {element: make} = tofscope;
  document.getElementById("tofscope-recordings")?.remove();  // of before a lost connection

  const dialog = make("dialog", "tofscope-card", document.body);
  dialog.id = "tofscope-recordings";
  dialog.setAttribute("aria-label", "Recordings");
  const search = make("input", "tofscope-search", dialog);
  search.type = "search";
  search.placeholder = "Search by any part of the name";
  search.setAttribute("aria-label", "Search recordings");
  search.setAttribute("aria-controls", "tofscope-rows");
  search.autocomplete = "off";
  search.spellcheck = false;
  const head = make("div", "tofscope-row tofscope-head", dialog);
  for (const title of ["Name", "Data", "Duration", "Frames", "Sensors", "Truth"])
    make("span", "", head, title);
  const list = make("div", "tofscope-rows", dialog);
  list.id = "tofscope-rows";
  list.setAttribute("role", "listbox");
  list.setAttribute("aria-label", "Recordings");
  const foot = make("div", "tofscope-foot", dialog);
  const count = make("span", "", foot);
  make("span", "", foot, "↑ ↓ and Enter choose, Esc closes");

  let rows = [], active = null;
  const matching = () => rows.filter(row => !row.element.hidden);

  // How long, in what one says.
  const duration = seconds => {
    if (seconds < 100) return `${seconds.toFixed(1)} s`;
    const minutes = Math.floor(seconds / 60);
    return `${minutes}:${String(Math.floor(seconds % 60)).padStart(2, "0")} min`;
  };

  const describe = (row, about) => {
    row.cells.replaceChildren();
    row.element.classList.toggle("unreadable", "reason" in about);
    if ("reason" in about) {
      make("span", "tofscope-reason", row.cells, about.reason);
      return;
    }
    const {simulated, scenario, seconds, frames, sensors, truth} = about;
    const data = !simulated ? "measured" : scenario ? `simulated: ${scenario}` : "simulated";
    make("span", "", row.cells, data).title = data;
    const numbers = [duration(seconds), frames.toString(), sensors.toString(), truth ? "yes" : "no"];
    for (const text of numbers) make("span", "", row.cells, text);
  };

  const seen = new Set();  // places of the rows that are in view and not described yet
  const watcher = new IntersectionObserver(entries => {
    for (const {target, isIntersecting} of entries) {
      const place = Number(target.dataset.place);
      if (isIntersecting) seen.add(place); else seen.delete(place);
    }
    tofscope.tellLatest("recordings.seen", {rows: [...seen].slice(0, 100)}, 200);
  }, {root: list});

  const row = (label, place, open) => {
    const element = make("div", "tofscope-row");
    element.setAttribute("role", "option");
    element.id = `tofscope-row-${place}`;
    element.dataset.place = place;
    element.title = label;
    const name = make("span", "tofscope-name", element);
    const [last, ...folders] = label.split("/").reverse();
    if (folders.length) make("span", "tofscope-folder", name, `${folders.reverse().join("/")}/`);
    name.append(last);
    element.setAttribute("aria-selected", String(label === open));
    if (label === open) make("span", "tofscope-open", name, "open");
    const cells = make("span", "tofscope-cells", element);
    return {element, cells, label, name: label.toLowerCase()};
  };

  const activate = wanted => {
    active?.element.classList.remove("active");
    active = wanted ?? null;
    active?.element.classList.add("active");
    if (active) search.setAttribute("aria-activedescendant", active.element.id);
    else search.removeAttribute("aria-activedescendant");
    active?.element.scrollIntoView({block: "nearest"});
  };

  const filter = () => {
    const parts = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    for (const each of rows)
      each.element.hidden = !parts.every(part => each.name.includes(part));
    const left = matching();
    const all = rows.length === 1 ? "1 recording" : `${rows.length} recordings`;
    count.textContent = parts.length ? `${left.length} of ${all}` : all;
    if (!active || active.element.hidden) activate(left[0]);
  };

  const choose = wanted => {
    if (!wanted) return;
    dialog.close();
    tofscope.tell("recordings.choose", {label: wanted.label});
  };

  const move = steps => {
    const left = matching(), place = left.indexOf(active);
    activate(left[Math.min(Math.max(place + steps, 0), left.length - 1)]);
  };
  const moves = {ArrowDown: 1, ArrowUp: -1, PageDown: 10, PageUp: -10};

  search.addEventListener("input", filter);
  dialog.addEventListener("keydown", event => {
    if (event.key in moves) move(moves[event.key]);
    else if (event.key === "Enter") choose(active);
    else if (event.key === "Escape") dialog.close();  // also with something typed
    else if (event.key !== "Tab") return event.stopPropagation();  // keys of the page stay quiet
    if (event.key !== "Tab") event.preventDefault();
    event.stopPropagation();
  });
  dialog.addEventListener("click", event => {
    if (event.target === dialog) return dialog.close();  // beside the card
    const place = event.target.closest(".tofscope-rows > .tofscope-row")?.dataset.place;
    if (place !== undefined) choose(rows[Number(place)]);
  });
  dialog.addEventListener("close", () => {
    seen.clear();
    tofscope.tell("recordings.close", {});
    setTimeout(() => document.activeElement?.blur());  // the keys are playback's again
  });

  tofscope.recordings = {
    // Shows the list as it was, and asks for it as it is.
    show: () => {
      if (dialog.open) return;
      search.value = "";
      filter();
      dialog.showModal();
      search.focus();
      tofscope.tell("recordings.look", {});
    },

    // Fills it anew with these names, of which one is open.
    fill: (labels, open) => {
      const before = active?.label ?? open;
      watcher.disconnect();
      seen.clear();
      rows = labels.map((label, place) => row(label, place, open));
      list.replaceChildren(...rows.map(each => each.element));
      active = null;
      activate(rows.find(each => each.label === before));
      filter();
      for (const each of rows) watcher.observe(each.element);
    },

    // What is in recordings, {name: what, or the reason why it cannot be opened}.
    describe: found => {
      for (const each of rows) {
        if (!Object.hasOwn(found, each.label)) continue;
        describe(each, found[each.label]);
        watcher.unobserve(each.element);
        seen.delete(Number(each.element.dataset.place));
      }
    },
  };

  tofscope.atOnce.o = tofscope.recordings.show;

  // Buttons beside the name of the open recording.
  if (!tofscope.recordingButtons) {
    tofscope.recordingButtons = true;
    document.addEventListener("click", event => {
      const button = event.target.closest("[data-recordings]");
      if (!button) return;
      button.blur();
      if (button.dataset.recordings === "show") tofscope.recordings.show();
      else if (button.dataset.recordings === "notes") tofscope.notes.show();
      else tofscope.tell("recordings.step", {steps: Number(button.dataset.recordings)});
    });
  }
}
