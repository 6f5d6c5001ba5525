"""A client that speaks viser's protocol over a websocket, and draws nothing."""

import json
import threading
import time
from collections.abc import Callable
from dataclasses import asdict
from typing import Any

import msgspec
import viser
import zstandard
from viser import _messages as messages
from viser.infra import Message
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from tests.app.page_calls import PageCalls


def camera_at(position: tuple[float, float, float]) -> messages.ViewerCameraMessage:
    """A page's message about its camera at a position in metres, which looks at the origin."""
    return messages.ViewerCameraMessage(
        wxyz=(1.0, 0.0, 0.0, 0.0),
        position=position,
        fov=0.9,
        near=0.01,
        far=1000.0,
        image_height=720,
        image_width=1280,
        look_at=(0.0, 0.0, 0.0),
        up_direction=(0.0, 0.0, 1.0),
    )


class WireClient:
    """Connects as a browser does, answers what a browser answers, and tells what it receives.

    Args:
        address: of the server, such as http://127.0.0.1:8080.
        listen: is called in the client's own thread with the time (of `time.perf_counter`) and
            each message, {"type": its name, field: value}; arrays are left out.
        storage: what the browser has stored.

    Attributes:
        received: bytes that came so far.
    """

    def __init__(
        self,
        address: str,
        listen: Callable[[float, dict[str, Any]], None] = lambda *_: None,
        storage: dict[str, str] | None = None,
    ):
        self.received = self._told = 0
        self.storage = {} if storage is None else storage
        self._listen = listen
        self._values: dict[str, Any] = {}
        self._uuids: dict[str, str] = {}
        self._commands: dict[str, str] = {}
        self._calls = PageCalls()
        self._told = 0
        self._socket = connect(
            address.replace("http", "ws", 1),
            subprotocols=[f"viser-v{viser.__version__}"],  # type: ignore[list-item]
            compression=None,
            max_size=None,
        )
        self._thread = threading.Thread(target=self._receive, daemon=True)
        self._thread.start()
        self.look_from((2.0, -2.0, 1.5))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self._socket.close()
        self._thread.join(10)

    def send(self, message: Message) -> None:
        fields = asdict(message) | {"type": type(message).__name__}  # type: ignore[call-overload]
        self._socket.send(msgspec.msgpack.encode(fields))

    def look_from(self, position: tuple[float, float, float]) -> None:
        """Send the camera's position in metres; viser announces a client at the first one."""
        self.send(camera_at(position))

    def change(self, label: str, value: Any) -> None:
        """Send a control's new value."""
        uuid = self._uuids[label]
        self._values[uuid] = value
        self.send(messages.GuiUpdateMessage(uuid, {"value": value}))

    def tell(self, kind: str, data: Any = None) -> None:
        """Send an event of one of our own elements, as the page's scripts do."""
        self._told += 1
        text = json.dumps({"kind": kind, "number": self._told, "data": data})
        self.change("Events of the page", text)

    def shown(self, function: str) -> list[Any] | None:
        """Arguments of the last call of a function of our scripts, such as "timeline.frame"."""
        return self._calls.shown(function)

    def trigger(self, label: str) -> None:
        """Send the choice of a command, as its key does."""
        self.send(messages.CommandTriggerMessage(self._commands[label]))

    def has(self, label: str) -> bool:
        """Whether there is a control of this label."""
        return label in self._uuids

    def value(self, label: str) -> Any:
        """Value of a control."""
        return self._values[self._uuids[label]]

    def _receive(self) -> None:
        unzip = zstandard.ZstdDecompressor()
        try:
            for data in self._socket:
                now = time.perf_counter()
                assert isinstance(data, bytes)
                self.received += len(data)
                size, length = (int.from_bytes(data[i : i + 8], "little") for i in (0, 8))
                window = unzip.decompress(data[16 : 16 + length], max_output_size=size)
                for message in msgspec.msgpack.decode(window)["messages"]:
                    self._take(message)
                    self._listen(now, message)
        except ConnectionClosed:
            pass

    def _take(self, message: dict[str, Any]) -> None:
        match message["type"]:
            case "LocalStorageGetItemRequestMessage":
                value = self.storage.get(message["key"])
                uuid = message["request_uuid"]
                self.send(messages.LocalStorageGetItemResponseMessage(value, None, uuid))
            case "LocalStorageSetItemMessage":
                self.storage[message["key"]] = message["value"]
            case "LocalStorageRemoveItemMessage":
                self.storage.pop(message["key"], None)
            case "RunJavascriptMessage":
                self._calls.note(message["source"])
            case "RegisterCommandMessage":
                self._commands[message["props"]["label"]] = message["uuid"]
            case "GuiUpdateMessage" if "value" in message["updates"]:
                self._values[message["uuid"]] = message["updates"]["value"]
            case _ if "value" in message and "label" in message.get("props", {}):
                self._uuids[message["props"]["label"]] = message["uuid"]
                self._values[message["uuid"]] = message["value"]
