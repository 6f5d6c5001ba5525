// viser's notice that the browser draws without a graphics card stays until it is closed, over the
// scene. Here it goes after a while, and comes once in a tab.
window.tofscope ??= {};
if (!window.tofscope.tidiesNotices) {
  window.tofscope.tidiesNotices = true;
  const KEY = "tofscope-software", READ = 8000;  // milliseconds
  const viewer = window.__viserMutable;
  const remove = () => {
    sessionStorage.setItem(KEY, "told");
    viewer.messageQueue.push({type: "RemoveNotificationMessage", uuid: "webgl-software-rendering"});
    viewer.requestRender();
  };
  setTimeout(remove, sessionStorage.getItem(KEY) ? 0 : READ);
}
