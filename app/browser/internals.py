"""Private parts of viser, of its page and of websockets that the app relies on, and why.

All of them are here, and `tests/app/browser/test_internals.py` says of each when an upgrade has
changed it.
"""

import contextlib
import functools
import http
from collections.abc import Callable, Iterator
from typing import Any

import viser
import websockets.asyncio.server as websocket_server
from viser._messages import GuiUpdateMessage, RunJavascriptMessage
from websockets.asyncio.server import ServerConnection
from websockets.http11 import Request, Response

SCENE_CANVAS = "canvas[data-engine]"
"""Canvas of the scene, by the attribute that three.js leaves: viser does not tell its size."""

FOLDER_ARROW = "svg.tabler-icon-chevron-down"
"""Arrow of a folder that is closed: viser cannot open a folder later."""

NUMBER_INPUT = "input.mantine-NumberInput-input"
"""Input of a number field: a number that is left empty has to come back."""

PLOT_AREA = ".u-over"
"""Area of a plot that the mouse meets: viser tells of no click in it."""

PLOT_CANVAS = ".uplot canvas"
"""Canvas of a plot, to draw it pale."""

DROPDOWN = "[aria-haspopup=listbox]"
"""Input of a dropdown; the list that it opens is named by its `aria-controls`."""

DROPDOWN_OPTION = "[role=option]"
"""Option of a dropdown, in the list that it opens."""

SLIDER_OR_TAB = "[role=slider], [role=tab]"
"""Controls that arrow keys move: viser gives those keys to playback and the camera as well."""

STORAGE_PREFIX = "viser-user:"
"""Prefix that viser puts before the keys of a browser's storage that Python reads and removes."""

PAGE_TITLE = "<title>Viser</title>"
"""Title in viser's page, in whose place an offline page has its own."""

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
"""Script of an offline page: where viser's player begins again or is set back, it lights the scene
in its own way until the browser's next image. Messages that are taken at once leave no such image
between."""

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

CONNECTION_LOGGER = "websockets.server"
"""Logger that calls a connection an error which ends before it asked for anything: browsers make
such connections."""

CLOSED_CONNECTION = r"Queued a .* on a closed connection"
"""Warning of viser about a message to a client that has gone, which is no mistake of ours."""

_Answer = Callable[[ServerConnection, Request], Response | None]


def element_id(control: viser.GuiInputHandle[Any]) -> str:
    """Id of a control's element in the page, by which scripts of ours find it."""
    return control._impl.uuid


def call_in_event_loop(control: viser.GuiInputHandle[Any], action: Callable[[], None]) -> None:
    """Call something in the event loop that calls back for a control, so that neither interrupts.

    viser puts what a person chose into the control there, and calls back at once.
    """
    control._impl.gui_api._event_loop.call_soon_threadsafe(action)


def send_value(control: viser.GuiInputHandle[Any]) -> None:
    """Send the value of a control to the page again, which viser does only with another one."""
    message = GuiUpdateMessage(control._impl.uuid, {"value": control.value})
    control._impl.gui_api._websock_interface.queue_message(message)


def run_script(client: viser.ClientHandle, script: str) -> None:
    """Run a script in the page, after whatever was sent before; viser offers no way to."""
    client.gui._websock_interface.queue_message(RunJavascriptMessage(source=script))


@contextlib.contextmanager
def guarding_requests(refused: Callable[[Request], str | None]) -> Iterator[None]:
    """Give the server that viser starts meanwhile a guard, for which viser has no argument.

    Args:
        refused: says why a request is refused, None where it is answered.
    """
    serve = websocket_server.serve

    @functools.wraps(serve)
    def guarded(*arguments: Any, process_request: _Answer, **options: Any) -> Any:  # noqa: ANN401
        def answer(connection: ServerConnection, request: Request) -> Response | None:
            if (reason := refused(request)) is not None:
                return connection.respond(http.HTTPStatus.FORBIDDEN, reason)
            return process_request(connection, request)

        return serve(*arguments, process_request=answer, **options)

    setattr(websocket_server, "serve", guarded)  # noqa: B010 (a class is not assignable to)
    try:
        yield
    finally:
        setattr(websocket_server, "serve", serve)  # noqa: B010
