// What a person does with elements of ours, sent to the session that the page belongs to.
window.tofscope ??= {};
{
  const tofscope = window.tofscope;
  tofscope.sent ??= 0;

  // Sends one event; `data` is anything that JSON can hold.
  tofscope.tell = (kind, data) => {
    tofscope.sent += 1;  // makes equal events differ: equal values are not sent on
    const value = JSON.stringify({kind, number: tofscope.sent, data});
    window.__viserMutable.sendMessage(
      {type: "GuiUpdateMessage", uuid: tofscope.field, updates: {value}});
  };

  // Like `tell`, but at most once per `pause` milliseconds and kind, the latest always.
  const waiting = new Map();
  tofscope.tellLatest = (kind, data, pause = 30) => {
    if (waiting.has(kind)) {
      waiting.set(kind, {data});
      return;
    }
    tofscope.tell(kind, data);
    waiting.set(kind, null);
    setTimeout(() => {
      const later = waiting.get(kind);
      waiting.delete(kind);
      if (later) tofscope.tellLatest(kind, later.data, pause);
    }, pause);
  };
}
