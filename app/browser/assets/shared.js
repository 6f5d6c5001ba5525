// What several of our scripts need: elements of the page, times, numbers as the session sends them.
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

  // The box over the page with an id; the same after a lost connection.
  tofscope.overlay = id => {
    const box = document.getElementById(id) ?? document.createElement("div");
    box.id = id;
    document.body.append(box);
    return box;
  };

  // An action that runs once before the next picture, however often it is asked for until then.
  tofscope.once = act => {
    let waiting = false;
    return () => {
      if (waiting) return;
      waiting = true;
      requestAnimationFrame(() => {
        waiting = false;
        act();
      });
    };
  };

  // Index of the first of increasing times that is not before `time`; their number if all are.
  tofscope.indexOf = (times, time) => {
    let low = 0, high = times.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (times[middle] < time) low = middle + 1; else high = middle;
    }
    return low;
  };
  // Index of the nearest of increasing times.
  tofscope.nearest = (times, time) => {
    const k = Math.min(tofscope.indexOf(times, time), times.length - 1);
    return k > 0 && time - times[k - 1] < times[k] - time ? k - 1 : k;
  };

  // Share of each of some columns, from 0 on and 1 wide, that spans [start, end] cover.
  tofscope.covered = (spans, columns) => {
    const shares = new Float32Array(columns);
    for (const [start, end] of spans) {
      for (let from = Math.max(start, 0), to; from < Math.min(end, columns); from = to) {
        to = Math.min(Math.floor(from) + 1, end);
        shares[Math.floor(from)] += to - from;
      }
    }
    return shares.map(share => Math.min(share, 1));
  };

  // Keeps the height of an element in a property of the page, for what stands above or below.
  tofscope.watchHeight = (element, property) => {
    const page = document.documentElement.style;
    const observer = new ResizeObserver(() =>
      page.setProperty(property, `${element.offsetHeight}px`));
    observer.observe(element);
    return observer;
  };

  // Lets what a person has set stand until the session knows of it, which still says older values
  // meanwhile: `told` notes what is set, and `heard` applies what the session says.
  const PATIENCE = 400;  // milliseconds
  tofscope.untilKnown = apply => {
    let awaited = null, last = null, timer = null;
    const forget = () => {
      clearTimeout(timer);
      awaited = last = null;
    };
    const settle = () => {
      const value = last;
      forget();
      if (value !== null) apply(value);
    };
    return {
      forget,
      told(value) {
        forget();
        awaited = JSON.stringify(value);
        timer = setTimeout(settle, PATIENCE);
      },
      heard(value) {
        last = value;
        if (awaited === null || awaited === JSON.stringify(value)) settle();
      },
    };
  };

  // Bytes of a text in base64; a typed array over their `buffer` reads other numbers.
  tofscope.bytes = text => Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
}
