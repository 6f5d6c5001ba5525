// Tells when the system of the person at the page becomes dark or light.
window.tofscope ??= {};
if (!window.tofscope.system) {
  window.tofscope.system = matchMedia("(prefers-color-scheme: dark)");
  window.tofscope.system.addEventListener("change", ({matches}) =>
    window.tofscope.tell("system", {dark: matches}));
}
