"""Private parts of viser and of its page that the app relies on, and why.

`tests/app/browser/test_internals.py` fails for each that an upgrade has changed.
"""

from collections.abc import Callable
from functools import cache
from typing import Any
from zipfile import ZipFile

import viser
from viser import _gui_api, _gui_handles
from viser._icons import ICONS_DIR
from viser._messages import GuiUpdateMessage, RunJavascriptMessage

SCENE_CANVAS = "canvas[data-engine]"
"""Canvas of the scene, by three.js's attribute; used for its size, which viser does not report."""

NUMBER_INPUT = "input.mantine-NumberInput-input"
"""Input of a number field; used to restore a number that is left empty."""

DROPDOWN = "[aria-haspopup=listbox]"
"""Input of a dropdown; its `aria-controls` names the list that it opens."""

DROPDOWN_OPTION = "[role=option]"
"""Option of a dropdown, in the list that it opens."""

SLIDER_OR_TAB = "[role=slider], [role=tab]"
"""Controls moved by arrow keys, which viser also gives to playback and the camera."""

STORAGE_PREFIX = "viser-user:"
"""Prefix of the browser storage keys that viser lets Python read and remove."""

FULL_RESOLUTION = "?fixedDpr=1"
"""Query of viser's page that keeps one pixel per CSS pixel. Otherwise a page that draws slowly goes
down to three quarters, and its pictures are enlarged from that."""

PAGE_TITLE = "<title>Viser</title>"
"""Title in viser's page, which our front page and an offline page replace."""

PAGE_ROOT = "#root"
"""Element that viser's page draws into; hidden until our panels are there."""

SETTINGS_ICON = "svg.tabler-icon-adjustments"
"""Icon of the button that shows viser's own settings in place of our panels; removed."""

CONNECTION_NEWS = ("connected", "closed")
"""Types of the messages by which the worker that holds the connection says how it is; used to tell
a lost connection, which viser shows by a small icon alone."""

NO_FLASH = """<script>
const waiting = setInterval(() => {
  const viewer = window.__viserMutable;
  if (!viewer?.drainMessageQueue || !viewer.requestRender) return;
  clearInterval(waiting);
  const render = viewer.requestRender;
  viewer.requestRender = () => {
    if (viewer.messageQueue.length > 0) viewer.drainMessageQueue();
    render();
  };
}, 20);
</script>"""
"""Script of an offline page that prevents a flash: when viser's player restarts or seeks, it shows
its default lights until the next image, unless queued messages are applied at once."""

PAUSE_TO_TYPE = f"""<script>
document.addEventListener("focusin", event => {{
  if (!event.target.matches("{NUMBER_INPUT}")) return;
  document.querySelector("svg.tabler-icon-player-pause-filled")?.closest("button").click();
}});
const leave = event => {{
  const field = document.activeElement;
  if (field?.matches("{NUMBER_INPUT}") && (event.key ? event.key === " " : event.target !== field))
    field.blur();
}};
document.addEventListener("keydown", leave, true);
document.addEventListener("pointerdown", leave, true);
</script>"""
"""Script of an offline page that pauses when its time field gets the focus, and takes the focus
away where it is played on: viser's player writes the current time into the field 120 times a
second, in between what is being typed."""

SEND_AT_ONCE = """
if (!window.tofscopeSends) {
  window.tofscopeSends = true;
  const viewer = window.__viserMutable, wait = window.setTimeout;
  let send = viewer.sendMessage, changed = false;
  Object.defineProperty(viewer, "sendMessage", {
    get: () => message => {
      changed = message.type === "GuiUpdateMessage";
      queueMicrotask(() => { changed = false; });
      send(message);
    },
    set: next => { send = next; },  // viser sets it with each connection
  });
  window.setTimeout = (action, delay, ...values) => {
    if (!changed || delay !== 50) return wait(action, delay, ...values);
    changed = false;
    action();
    return 0;
  };
}
"""
"""Script that lets the page send every change of a control. After one, viser waits for 50 ms and
then sends the last of those made meanwhile, of whatever control: a click on a button and a number
that is typed get lost between others, the more the busier the page is."""

KEEP_TYPED = f"""
if (!window.tofscopeKeeps) {{
  window.tofscopeKeeps = true;
  const viewer = window.__viserMutable, queue = viewer.messageQueue, held = new Map();
  const typedInto = uuid => {{
    const field = document.activeElement;
    return field?.matches("{NUMBER_INPUT}")
      && document.getElementById(uuid)?.parentElement.contains(field);
  }};
  queue.push = message => {{
    if (message.type === "GuiUpdateMessage" && "value" in message.updates
        && typedInto(message.uuid)) {{
      const {{value, ...updates}} = message.updates;
      held.set(message.uuid, value);
      message = {{...message, updates}};
    }}
    return Array.prototype.push.call(queue, message);
  }};
  document.addEventListener("input", () => {{  // newer than what was held
    for (const uuid of [...held.keys()]) if (typedInto(uuid)) held.delete(uuid);
  }});
  document.addEventListener("focusout", () => setTimeout(() => {{
    for (const [uuid, value] of held) {{
      if (typedInto(uuid)) continue;
      held.delete(uuid);
      queue.push({{type: "GuiUpdateMessage", uuid, updates: {{value}}}});
      viewer.requestRender();
    }}
  }}));
}}
"""
"""Script that holds values which arrive for a number field while it has the focus, until it loses
it. viser shows them at once: they take the place of what is selected or half typed there, and the
next keys go into another number than the one that was meant."""

NO_FRAME_FOR_SCRIPTS = """
if (!window.tofscopeScripts) {
  window.tofscopeScripts = true;
  const viewer = window.__viserMutable, render = viewer.requestRender;
  const aside = ({type}) =>
    type === "RunJavascriptMessage" || type.startsWith("Gui") && type !== "Gui3DMessage";
  viewer.requestRender = () => {
    const queue = viewer.messageQueue;
    const apply = viewer.getRenderRequestState === "ready" ? viewer.drainMessageQueue : null;
    if (apply && queue.length > 0 && queue.every(aside)) apply();
    else render();
  };
}
"""
"""Script that runs our scripts without another image of the scene. viser applies messages for its
panel at once, but a script only with the next image, which it draws for that."""


def element_id(control: viser.GuiInputHandle[Any]) -> str:
    """Id of a control's element in the page, for scripts."""
    return control._impl.uuid


def hints_of(client: viser.ClientHandle) -> dict[str, str]:
    """{id of a control's element: its hint} of the page's controls that have one."""
    controls = list(client.gui._gui_input_handle_from_uuid.values())
    hints = {control._impl.uuid: getattr(control, "hint", None) for control in controls}
    return {name: hint for name, hint in hints.items() if hint}


def call_in_event_loop(control: viser.GuiInputHandle[Any], action: Callable[[], None]) -> None:
    """Run an action in the event loop that runs a control's callbacks.

    viser assigns a user's value and calls back there without interruption.
    """
    control._impl.gui_api._event_loop.call_soon_threadsafe(action)


def send_value(control: viser.GuiInputHandle[Any]) -> None:
    """Send the value of a control to the page again, which viser does only with another one."""
    message = GuiUpdateMessage(control._impl.uuid, {"value": control.value})
    control._impl.gui_api._websock_interface.queue_message(message)


def run_script(client: viser.ClientHandle, script: str) -> None:
    """Run a script in the page, after all messages sent before."""
    client.gui._websock_interface.queue_message(RunJavascriptMessage(source=script))


def keep_icons_open() -> None:
    """Keep viser's archive of icons open.

    For each icon viser opens it and reads its list of thousands, half a second in all before a
    first page is there.
    """
    for module in (_gui_api, _gui_handles):
        module.svg_from_icon = icon_svg  # type: ignore[assignment]


@cache
def icon_svg(name: str) -> str:
    """The drawing of an icon, as viser gives it to the page."""
    return _icons().read(f"{name}.svg").decode("utf-8")


@cache
def _icons() -> ZipFile:
    return ZipFile(ICONS_DIR / "tabler-icons.zip")
