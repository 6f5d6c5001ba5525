"""Scripts for the page, for what viser offers no way to ask of it."""

from uuid import uuid4

import viser

from app.browser.internals import (
    SCENE_CANVAS,
    SEND_AT_ONCE,
    SLIDER_OR_TAB,
    STORAGE_PREFIX,
    run_script,
)

# viser gives its hotkeys every key that is not typed into a text field, and arrow keys to the
# camera as well. Events bubble from the element with the focus over `body`, behind which nothing
# is a control any more, to `html`, where hotkeys are heard, and `document`, where the camera is.
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

# Panels may be docked beside the scene; a size that follows from theirs is told by the scene's.
_EDGE = f"""
if (!window.tofscopeEdge) {{
  const canvas = document.querySelector("{SCENE_CANVAS}");
  const follow = () => document.documentElement.style.setProperty(
    "--scene-left", `${{canvas.getBoundingClientRect().left}}px`);
  if (canvas) {{
    window.tofscopeEdge = new ResizeObserver(follow);
    window.tofscopeEdge.observe(canvas);
  }}
}}
"""

_SIZE_TO_STORAGE = f"""
const canvas = document.querySelector("{SCENE_CANVAS}");
localStorage.setItem("{STORAGE_PREFIX}%s", `${{canvas.clientWidth}} ${{canvas.clientHeight}}`);
"""

# A server never learns the address of viser's page; what its storage holds it may ask for. The
# address is cleaned, so that a reload comes back to what was shown last and not to the link.
_LINK = "link"
_LINK_TO_STORAGE = f"""
const query = new URLSearchParams(location.search);
const link = query.get("{_LINK}");
if (link !== null) {{
  localStorage.setItem("{STORAGE_PREFIX}{_LINK}", link);
  query.delete("{_LINK}");
  history.replaceState(null, "", location.pathname + (query.size ? "?" + query : ""));
}}
"""

# A browser's storage is shared by its tabs, and each of them is a session of its own.
_TOKEN = "session"
_TOKEN_TO_STORAGE = f"""
localStorage.setItem(
  "{STORAGE_PREFIX}{_TOKEN}", sessionStorage.getItem("tofscope-{_TOKEN}") ?? "");
"""
_KEEP_TOKEN = f"""
sessionStorage.setItem("tofscope-{_TOKEN}", "%s");
"""

# Browsers open the clipboard to pages of this machine and of https alone.
_COPY_LINK = """
const link = `${location.origin}${location.pathname}?%s=%s`;
const show = () => window.prompt("Copy this link:", link);
if (navigator.clipboard) navigator.clipboard.writeText(link).catch(show); else show();
"""


def set_up_sending(client: viser.ClientHandle) -> None:
    """Let the page send every change of a control, however fast they follow each other."""
    run_script(client, SEND_AT_ONCE)


def set_up_keys(client: viser.ClientHandle) -> None:
    """Leave keys to a slider that has the focus, and left and right to playback."""
    run_script(client, _KEYS)


def take_link(client: viser.ClientHandle, timeout: float) -> str | None:
    """The token of the link that the page was opened with, once; None where there is none.

    Raises:
        RuntimeError: the client has gone, or its browser stores nothing.
        TimeoutError: it has not answered within `timeout` seconds.
    """
    run_script(client, _LINK_TO_STORAGE)
    token = client.local_storage.get_item(_LINK, timeout=timeout)
    if token is not None:
        client.local_storage.remove_item(_LINK)
    return token


def take_token(client: viser.ClientHandle, timeout: float) -> str | None:
    """Token that `keep_token` left in this tab, None where it left none.

    Raises:
        RuntimeError: the client has gone, or its browser stores nothing.
        TimeoutError: it has not answered within `timeout` seconds.
    """
    run_script(client, _TOKEN_TO_STORAGE)
    return client.local_storage.get_item(_TOKEN, timeout=timeout) or None


def keep_token(client: viser.ClientHandle, token: str) -> None:
    """Leave a token in this tab, for when the page is loaded again."""
    run_script(client, _KEEP_TOKEN % token)


def copy_link(client: viser.ClientHandle, token: str) -> None:
    """Put the page's address with this token into the clipboard, or show it."""
    run_script(client, _COPY_LINK % (_LINK, token))


def set_up_scene_edge(client: viser.ClientHandle) -> None:
    """Tell style sheets where the scene begins, as `--scene-left`."""
    run_script(client, _EDGE)


def canvas_size(client: viser.ClientHandle) -> tuple[int, int]:
    """Width and height of the scene in the page in CSS pixels, which viser does not tell.

    What it tells are a screen's pixels: more on a fine screen, fewer on a slow machine.
    """
    key = f"canvas-{uuid4()}"  # tabs share their storage
    run_script(client, _SIZE_TO_STORAGE % key)
    try:
        told = client.local_storage.get_item(key, timeout=5.0)
        client.local_storage.remove_item(key)
        width, height = (int(side) for side in (told or "").split())
    except (RuntimeError, TimeoutError, ValueError):
        width, height = client.camera.image_width, client.camera.image_height
    return max(width, 1), max(height, 1)
