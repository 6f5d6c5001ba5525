"""Scripts for the page: keys, storage, clipboard, and the scene's size."""

from uuid import uuid4

import viser

from app.browser.assets import call, run_asset
from app.browser.internals import (
    KEEP_TYPED,
    NO_FRAME_FOR_SCRIPTS,
    SCENE_CANVAS,
    SEND_AT_ONCE,
    SLIDER_OR_TAB,
    STORAGE_PREFIX,
    hints_of,
    run_script,
)

# viser's hotkeys take every key not typed into a text field, and its camera takes arrow keys too.
# Events bubble from the focused element to `body`, which contains all controls, then to `html`,
# where hotkeys listen, and `document`, where the camera listens.
_KEYS = f"""
if (!window.tofscopeKeys) {{
  window.tofscopeKeys = true;
  const moves = new Set(["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Home", "End"]);
  document.body.addEventListener("keydown", event => {{
    const owner = event.target.closest("{SLIDER_OR_TAB}");
    if (owner && moves.has(event.key)) event.stopPropagation();
  }});
  document.documentElement.addEventListener("keydown", event => {{
    if (event.key === "ArrowLeft" || event.key === "ArrowRight") event.stopPropagation();
  }});
}}
"""

_NARROW_SCENE = 340  # pixels; what lies over a scene of less would leave nothing of it to be seen

# Docked panels shift the scene, on both sides. Its resize events report that at once, but not
# always: a panel that goes to the other side, or comes back after a lost connection, leaves the
# size as it was.
_EDGE = f"""
if (!window.tofscopeEdge) {{
  const canvas = document.querySelector("{SCENE_CANVAS}");
  const page = document.documentElement.style;
  let known = "";
  const follow = () => {{
    const {{left, right, width, height}} = canvas.getBoundingClientRect();
    const found = [left, window.innerWidth - right, width, height].map(pixels => `${{pixels}}px`);
    if (String(found) === known) return;  // a change has the whole page styled anew
    known = String(found);
    ["left", "right", "width", "height"].forEach((side, index) =>
      page.setProperty(`--scene-${{side}}`, found[index]));
    document.documentElement.toggleAttribute("data-narrow-scene", width < {_NARROW_SCENE});
  }};
  if (canvas) {{
    window.tofscopeEdge = new ResizeObserver(follow);
    window.tofscopeEdge.observe(canvas);
    setInterval(follow, 300);
  }}
}}
"""

_BACKGROUND = """
document.documentElement.style.setProperty("--scene-background", "%s");
"""

_SIZE_TO_STORAGE = f"""
const canvas = document.querySelector("{SCENE_CANVAS}");
localStorage.setItem("{STORAGE_PREFIX}%s", `${{canvas.clientWidth}} ${{canvas.clientHeight}}`);
"""

_WIDTH_TO_STORAGE = f"""
localStorage.setItem("{STORAGE_PREFIX}%s", window.innerWidth);
"""

# viser does not report the page's address, but can read its storage. The link is removed from the
# address first, so that a reload restores the last state and not the link's.
_LINK = "link"
_LINK_TO_STORAGE = f"""
const query = new URLSearchParams(location.search);
const link = query.get("{_LINK}");
if (link !== null) {{
  query.delete("{_LINK}");
  history.replaceState(null, "", location.pathname + (query.size ? "?" + query : ""));
  localStorage.setItem("{STORAGE_PREFIX}%s", link);
}}
"""

_PREFERENCE_TO_STORAGE = f"""
localStorage.setItem(
  "{STORAGE_PREFIX}%s", window.matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "");
"""

_TOKEN = "session"
_TOKEN_TO_STORAGE = f"""
localStorage.setItem(
  "{STORAGE_PREFIX}%s", sessionStorage.getItem("tofscope-{_TOKEN}") ?? "");
"""
_KEEP_TOKEN = f"""
try {{ sessionStorage.setItem("tofscope-{_TOKEN}", "%s"); }} catch {{}}
"""

# Browsers allow the clipboard only to pages of this machine or over https.
_COPY_LINK = """
const link = `${location.origin}${location.pathname}?%s=%s`;
const show = () => window.prompt("Copy this link:", link);
if (navigator.clipboard) navigator.clipboard.writeText(link).catch(show); else show();
"""


def set_up_scripts(client: viser.ClientHandle) -> None:
    """Let scripts run without another image of the scene."""
    run_script(client, NO_FRAME_FOR_SCRIPTS)


def set_up_controls(client: viser.ClientHandle) -> None:
    """Let the page send every change of a control, and leave alone what is typed or dragged."""
    run_asset(client, "controls.css")
    run_script(client, SEND_AT_ONCE)
    run_script(client, KEEP_TYPED)


def set_up_keys(client: viser.ClientHandle) -> None:
    """Reserve arrow keys for a focused slider, left and right for playback, others for panels."""
    run_script(client, _KEYS)
    run_asset(client, "keys.js")


def set_up_tabs(client: viser.ClientHandle) -> None:
    """Open again, after a reload, the tabs that were open; give them the height that is left."""
    run_asset(client, "tabs.js")
    run_asset(client, "panel_height.js")


def show_hints(client: viser.ClientHandle) -> None:
    """Show the hints of all controls at their labels, too, which viser shows at fields alone."""
    run_asset(client, "hints.js")
    call(client, "showHints", hints_of(client))


def take_link(client: viser.ClientHandle, timeout: float) -> str | None:
    """Take the token of the link that the page was opened with, None without one.

    Nothing of it stays in the browser.

    Raises:
        RuntimeError: the client has disconnected, or its browser has no storage.
        TimeoutError: no answer within `timeout` seconds.
    """
    return _answer(client, _LINK_TO_STORAGE, timeout) or None


def take_token(client: viser.ClientHandle, timeout: float) -> str | None:
    """Read the token that `keep_token` stored in this tab, None without one.

    Raises:
        RuntimeError: the client has disconnected, or its browser has no storage.
        TimeoutError: no answer within `timeout` seconds.
    """
    return _answer(client, _TOKEN_TO_STORAGE, timeout) or None


def prefers_dark(client: viser.ClientHandle, timeout: float) -> bool:
    """Whether the system of the person at the page is dark.

    Raises:
        RuntimeError: the client has disconnected, or its browser has no storage.
        TimeoutError: no answer within `timeout` seconds.
    """
    return _answer(client, _PREFERENCE_TO_STORAGE, timeout) == "dark"


def keep_token(client: viser.ClientHandle, token: str) -> None:
    """Store a token in this tab, for a reload of the page."""
    run_script(client, _KEEP_TOKEN % token)


def copy_link(client: viser.ClientHandle, token: str) -> None:
    """Copy the page's address with this token to the clipboard, or show it for copying."""
    run_script(client, _COPY_LINK % (_LINK, token))


def set_up_scene_edge(client: viser.ClientHandle) -> None:
    """Provide the scene's place to style sheets.

    Its distances from the window's sides are `--scene-left` and `--scene-right`; its size is
    `--scene-width` and `--scene-height`.
    """
    run_script(client, _EDGE)


def show_background(client: viser.ClientHandle, colour: str) -> None:
    """Show a colour, in CSS notation, behind the scene."""
    run_script(client, _BACKGROUND % colour)


def canvas_size(client: viser.ClientHandle) -> tuple[int, int]:
    """Width and height of the scene in the page in CSS pixels.

    viser reports device pixels, whose number varies with the screen and with its frame rate.
    """
    try:
        width, height = (int(side) for side in _answer(client, _SIZE_TO_STORAGE).split())
    except (RuntimeError, TimeoutError, ValueError):
        width, height = client.camera.image_width, client.camera.image_height
    return max(width, 1), max(height, 1)


def window_width(client: viser.ClientHandle) -> int:
    """Width of the page in CSS pixels, panels included.

    The scene's width is no measure of it: when a page connects again, panels of before still take
    their part.
    """
    try:
        return int(_answer(client, _WIDTH_TO_STORAGE))
    except (RuntimeError, TimeoutError, ValueError):
        return client.camera.image_width


def _answer(client: viser.ClientHandle, script: str, timeout: float = 5.0) -> str:
    """Result of a script that stores it under the key put into it, empty without one.

    Raises:
        RuntimeError: the client has disconnected, or its browser has no storage.
        TimeoutError: no answer within `timeout` seconds.
    """
    # Tabs share their storage, and what stays there after a lost connection must not be found.
    key = f"answer-{uuid4()}"
    # Where storage is forbidden, viser answers the request with the reason.
    run_script(client, f"try {{ {script % key} }} catch {{}}")
    try:
        return client.local_storage.get_item(key, timeout=timeout) or ""
    finally:
        client.local_storage.remove_item(key)
