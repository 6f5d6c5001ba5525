// What is seen before there is anything to see: what is being opened, or that the connection is
// lost. Runs in the head of the page, before all else.
window.tofscope ??= {};
{
  const root = document.documentElement;
  const stored = () => {
    try {
      return sessionStorage.getItem("tofscope-theme");
    } catch {
      return null;  // where the browser keeps nothing
    }
  };
  const system = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
  root.dataset.tofscopeTheme = stored() ?? system;
  root.classList.add("tofscope-starting");

  const card = document.createElement("div");
  card.id = "tofscope-opening";
  card.setAttribute("role", "status");
  const title = document.createElement("b"), sentence = document.createElement("span");
  title.textContent = "Tofscope";
  card.append(title, sentence);
  root.append(card);

  const say = (text, busy = true) => {
    sentence.textContent = text;
    card.classList.toggle("busy", busy);
    card.classList.add("shown");
  };
  say("Opening …");

  window.tofscope.opening = {
    show: name => {
      window.tofscope.failure?.close();
      say(`Opening ${name} …`);
    },
    // There is something to see: the page as a whole, and no card.
    end: () => {
      root.classList.remove("tofscope-starting");
      card.classList.remove("shown");
    },
    nothing: text => {
      root.classList.remove("tofscope-starting");
      say(text, false);
    },
    // A reload begins in the theme that a person chose, or else in the system's.
    theme: (dark, chosen) => {
      root.dataset.tofscopeTheme = dark ? "dark" : "light";
      try {
        if (chosen) sessionStorage.setItem("tofscope-theme", root.dataset.tofscopeTheme);
        else sessionStorage.removeItem("tofscope-theme");
      } catch { /* where the browser keeps nothing */ }
    },
  };

  let lost = false, everConnected = false;
  const tell = () => {
    if (!lost) return;
    const what = everConnected ? "The connection to Tofscope was lost" : "Tofscope does not answer";
    // Pages that are not in use do not try.
    say(document.hasFocus() ? `${what}; trying again …` : `${what}; click here to try again.`);
  };
  window.addEventListener("focus", tell);
  window.addEventListener("blur", tell);

  // The worker that holds the connection says how it is.
  const Plain = window.Worker;
  window.Worker = class extends Plain {
    constructor(...values) {
      super(...values);
      this.addEventListener("message", ({data}) => {
        if (data?.type === "closed") {
          lost = true;
          tell();
        } else if (data?.type === "connected") {
          if (lost || everConnected) root.classList.add("tofscope-starting");
          if (lost) say("Opening …");
          lost = false;
          everConnected = true;
        }
      });
    }
  };
}
