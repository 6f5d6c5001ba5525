"""A browser client without a browser: viser's scene and GUI, and a record of all messages sent."""

import asyncio
import contextlib
import io
import json
import re
from collections.abc import Iterator
from contextlib import contextmanager
from html import unescape
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import viser
from viser._messages import (
    CommandTriggerMessage,
    GuiUpdateMessage,
    RunJavascriptMessage,
    ScenePointerMessage,
)

from tests.app.page_calls import PageCalls


class FakeStorage:
    def __init__(self):
        self.items = {}

    def get_item(self, key, timeout=None):
        return self.items.get(key)

    def remove_item(self, key):
        self.items.pop(key, None)

    def set_item(self, key, value):
        self.items[key] = value


class FakeClient:
    """Stands in for a `viser.ClientHandle`, on the scene and GUI of a server of its own.

    Its storage is the browser's and the tab's in one; `link` is that of the page's address.
    """

    client_id = 1

    def __init__(self, server: viser.ViserServer, storage: FakeStorage | None = None):
        self.server, self.scene, self.gui = server, server.scene, server.gui
        self.camera = SimpleNamespace(
            position=np.array([2.0, -2.0, 1.5]),
            look_at=np.zeros(3),
            fov=0.9,
            near=0.01,
            image_height=60,
            image_width=80,
            on_update=lambda callback: callback,
        )
        self.local_storage = storage or FakeStorage()
        self.notifications: list[str] = []
        self.removed: list[str] = []
        self.downloads: list[tuple[str, bytes]] = []
        self.render: Any = np.zeros((60, 80, 4), dtype=np.uint8)
        self.sent: list[Any] = []
        self.link: str | None = None
        self.system_dark = False
        self._calls = PageCalls()
        self._told = 0
        server._connected_clients[self.client_id] = cast(Any, self)
        queue = server._websock_server.queue_message

        def keep(message):
            self.sent.append(message)
            if isinstance(message, RunJavascriptMessage):
                self._run(message.source)
            queue(message)

        server._websock_server.queue_message = keep

    def _run(self, script: str) -> None:
        """Carry out the scripts that store a value, and note calls of ours."""
        self._calls.note(script)
        if kept := re.search(r'sessionStorage.setItem\("tofscope-(\w+)", "(.*)"\)', script):
            self.local_storage.set_item(*kept.groups())
        if key := re.search(r'"viser-user:(answer-[\w-]+)"', script):
            if "prefers-color-scheme" in script:
                self.local_storage.set_item(key[1], "dark" if self.system_dark else "")
            elif "sessionStorage.getItem" in script:
                self.local_storage.set_item(key[1], self.local_storage.get_item("session") or "")
            elif 'query.get("link")' in script and self.link is not None:
                self.local_storage.set_item(key[1], self.link)
                self.link = None

    @classmethod
    @contextmanager
    def on_a_server(cls, storage: FakeStorage | None = None) -> Iterator[Any]:
        with contextlib.redirect_stdout(io.StringIO()):
            server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
        yield cls(server, storage)
        with contextlib.redirect_stdout(io.StringIO()):
            server.stop()

    @contextmanager
    def atomic(self):
        yield

    def flush(self):
        pass

    def add_notification(self, title, body, **_):
        self.notifications.append(body)
        return SimpleNamespace(body=body, remove=lambda: self.removed.append(body))

    def send_file_download(self, name, content, save_immediately=False):
        self.downloads.append((name, content))

    def get_render(self, height, width, **_):
        if isinstance(self.render, Exception):
            raise self.render
        return self.render

    def take_sent(self) -> list[Any]:
        taken, self.sent[:] = list(self.sent), []
        return taken

    def node(self, name: str):
        node = self.scene.get_handle_by_name(name)
        assert node is not None, f"the scene has no {name}"
        return cast(Any, node)

    def control(self, label: str):
        found = [
            handle
            for handle in self.gui._gui_input_handle_from_uuid.values()
            if getattr(handle, "label", None) == label
        ]
        assert len(found) == 1, f"{len(found)} controls are labelled {label}"
        return cast(Any, found[0])

    def change(self, label: str, value: Any) -> None:
        """Change a control, through viser's handler of a browser's message."""
        self._send(self.control(label), value)

    def _send(self, control: Any, value: Any) -> None:
        message = GuiUpdateMessage(control._impl.uuid, {"value": value})
        asyncio.run_coroutine_threadsafe(
            self.gui._handle_gui_updates(cast(Any, self.client_id), message),
            self.server.get_event_loop(),
        ).result(timeout=10)

    def tell(self, kind: str, data: Any = None) -> None:
        """Send an event of one of our own elements, as the page's scripts do."""
        self._told += 1
        text = json.dumps({"kind": kind, "number": self._told, "data": data})
        self._send(self.control("Events of the page"), text)

    def choose(self, recording: str) -> None:
        """Choose a recording from the list."""
        self.tell("recordings.choose", {"label": recording})

    def recording(self) -> str:
        """Name that the panel shows as the open recording's."""
        found = re.search(r'aria-label="Recording: ([^"]*)"', self.text())
        assert found, "no recording is named"
        return unescape(found[1])

    def called(self, function: str) -> list[list[Any]]:
        """Arguments of the calls of a function of our scripts so far."""
        begin = f"window.tofscope.{function}("
        sources = [m.source for m in self.sent if isinstance(m, RunJavascriptMessage)]
        calls = [s[len(begin) : -len(");")] for s in sources if s.startswith(begin)]
        return [json.loads(f"[{arguments}]") for arguments in calls]

    def shown(self, function: str) -> list[Any] | None:
        """Arguments of the last call of a function of our scripts, such as "timeline.frame"."""
        return self._calls.shown(function)

    @property
    def legend(self) -> str:
        """HTML of the legend, "" before there is one."""
        [html] = self.shown("legend.show") or [""]
        return html

    def press(self, label: str) -> None:
        """Press a button."""
        self.change(label, True)

    def press_option(self, label: str, option: str) -> None:
        """Press a button of a group with a label."""
        self._send(self.control(label), option)

    def press_group(self, option: str) -> None:
        """Press a button of a group without a label."""
        groups = self.gui._gui_input_handle_from_uuid.values()
        (found,) = [g for g in groups if option in getattr(g, "options", ()) and not g.label]
        self._send(found, option)

    def trigger(self, label: str) -> None:
        """Choose a command, as its key does."""
        found = [c for c in self.gui._command_handle_from_uuid.values() if c.label == label]
        assert len(found) == 1, f"{len(found)} commands are called {label}"
        message = CommandTriggerMessage(found[0]._impl.uuid)
        asyncio.run_coroutine_threadsafe(
            self.gui._handle_command_trigger(cast(Any, self.client_id), message),
            self.server.get_event_loop(),
        ).result(timeout=10)

    def click(self, origin: tuple[float, ...], direction: tuple[float, ...]) -> None:
        """Click into the scene along a ray."""
        message = ScenePointerMessage(
            "click", cast(Any, origin), cast(Any, direction), ((0.5, 0.5),), None
        )
        asyncio.run_coroutine_threadsafe(
            self.scene._handle_scene_pointer_updates(cast(Any, self.client_id), message),
            self.server.get_event_loop(),
        ).result(timeout=10)

    def text(self) -> str:
        """All HTML of the page."""
        return "\n".join(c.content for c in self._elements() if isinstance(c, viser.GuiHtmlHandle))

    def markdown(self) -> str:
        elements = self._elements()
        return "\n".join(c.content for c in elements if isinstance(c, viser.GuiMarkdownHandle))

    def buttons(self) -> list[viser.GuiButtonHandle]:
        return [c for c in self._elements() if isinstance(c, viser.GuiButtonHandle)]

    def _elements(self) -> list[Any]:
        containers = list(self.gui._container_handle_from_uuid.values())
        return [
            child
            for container in containers
            for child in list(getattr(container, "_children", {}).values())
        ]
