"""What the page has to do by itself in the browser, where viser offers no way to ask it."""

import viser
from viser._messages import RunJavascriptMessage

# viser gives its hotkeys every key that is not typed into a text field, and arrow keys to the
# camera as well. Events bubble from the element with the focus over `body`, behind which nothing
# is a control any more, to `html`, where hotkeys are heard, and `document`, where the camera is.
_KEYS = """
if (!window.tofscopeKeys) {
  window.tofscopeKeys = true;
  const moves = new Set(["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Home", "End"]);
  document.body.addEventListener("keydown", event => {
    const owner = event.target.closest("[role=slider], [role=tab]");
    if (owner && moves.has(event.key)) event.stopPropagation();
  });
  document.documentElement.addEventListener("keydown", event => {
    if (event.key === "ArrowLeft" || event.key === "ArrowRight") event.stopPropagation();
  });
}
"""

_HEIGHT = "canvas-height"
_CANVAS = "document.querySelector('canvas[data-engine]')"


def set_up_keys(client: viser.ClientHandle) -> None:
    """Leave keys to a slider that has the focus, and left and right to playback."""
    run(client, _KEYS)


def run(client: viser.ClientHandle, script: str) -> None:
    """Run a script in the page, after whatever was sent before."""
    client.gui._websock_interface.queue_message(RunJavascriptMessage(source=script))


def canvas_height(client: viser.ClientHandle) -> float:
    """Height of the scene in the page in CSS pixels, which viser does not tell.

    What it tells are a screen's pixels: more on a fine screen, fewer on a slow machine.
    """
    run(client, f"localStorage.setItem('viser-user:{_HEIGHT}', {_CANVAS}.clientHeight)")
    try:
        told = client.local_storage.get_item(_HEIGHT, timeout=5.0)
        return float(told) if told else float(client.camera.image_height)
    except (RuntimeError, TimeoutError, ValueError):
        return float(client.camera.image_height)
