"""Private parts of viser's server and of websockets, and how they are guarded.

`tests/app/browser/test_connections.py` fails for each that an upgrade has changed.
"""

import contextlib
import functools
import http
import logging
import time
from asyncio import sleep
from collections.abc import AsyncGenerator, Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Protocol

import viser
import viser.infra
import websockets.asyncio.server as websocket_server
from viser._messages import (
    CommandTriggerMessage,
    FileTransferPart,
    FileTransferPartAck,
    FileTransferStartUpload,
    GetRenderResponseMessage,
    GuiUpdateMessage,
    LocalStorageGetItemResponseMessage,
    Message,
    RemoveNotificationMessage,
    ScenePointerMessage,
    ViewerCameraMessage,
)
from viser.infra import WebsockClientConnection
from viser.infra._async_message_buffer import AsyncMessageBuffer
from websockets.asyncio.server import ServerConnection
from websockets.http11 import Request, Response
from websockets.protocol import State

from app.browser.completion import completing
from app.browser.encodable import encodable
from app.browser.pace import Pace

__all__ = [
    "CommandTriggerMessage",
    "FileTransferPart",
    "FileTransferStartUpload",
    "GetRenderResponseMessage",
    "GuiUpdateMessage",
    "LocalStorageGetItemResponseMessage",
    "ScenePointerMessage",
    "ViewerCameraMessage",
]

CONNECTION_LOGGER = "websockets.server"
"""Logger that reports connections closed before any request as errors; browsers open such
connections."""

CLOSED_CONNECTION = r"Queued a .* on a closed connection"
"""viser's warning about a message to a disconnected client, which is harmless."""

ODD_MESSAGE = r"(?s)\[viser\] (.* does not match annotation|Dropping upload) "
"""viser's warnings about what a client sends, one for each message."""

_PROTOCOL = f"viser-v{viser.__version__}"
_WAITING = 4  # messages of a client that wait to be handled; they may have 50 MB each
_LOG = logging.getLogger(__name__)

_Answer = Callable[[ServerConnection, Request], Response | None]


@dataclass(frozen=True)
class Unreadable:
    """Stands for a message that cannot be decoded.

    Attributes:
        error: what was raised.
    """

    error: Exception


class Attendant(Protocol):
    """Decides about the messages of one client; its methods run in viser's event loop."""

    def admits(self, message: object) -> bool:
        """Whether a message is handled; it is `Unreadable` or one of viser's."""
        ...

    def failed(self, error: Exception) -> None:
        """Note that a message could not be handled."""
        ...

    def leave(self) -> None:
        """The client has gone."""
        ...


@dataclass(frozen=True)
class Guards:
    """How a server is guarded.

    Attributes:
        refused: status and reason to refuse a request with, None to answer it.
        headers: of all answers.
        attend: makes the attendant of a client from its number and what ends its connection.
        page: changes the page that viser sends.
    """

    refused: Callable[[Request], tuple[http.HTTPStatus, str] | None]
    headers: Mapping[str, str]
    attend: Callable[[int, Callable[[], None]], Attendant]
    page: Callable[[bytes], bytes] = lambda html: html


@contextlib.contextmanager
def guarding(guards: Guards) -> Iterator[None]:
    """Context in which a server made by viser gets guards, which viser cannot take."""
    serve, server = websocket_server.serve, viser.infra.WebsockServer
    setattr(websocket_server, "serve", _guarded_serving(serve, guards))  # noqa: B010
    setattr(viser.infra, "WebsockServer", _guarded_server(server, guards))  # noqa: B010
    try:
        yield
    finally:
        setattr(websocket_server, "serve", serve)  # noqa: B010 (classes are not assignable to)
        setattr(viser.infra, "WebsockServer", server)  # noqa: B010


def accepts_files(client: viser.ClientHandle, control: str) -> bool:
    """Whether a control of the page, by its id, is one for uploads."""
    found = client.gui._gui_input_handle_from_uuid.get(control)
    return isinstance(found, viser.GuiUploadButtonHandle)


def end_upload(client: viser.ClientHandle, message: FileTransferStartUpload) -> None:
    """Let the page end an upload that is not taken: it waits to hear of its last byte."""
    send, size = client.gui._websock_interface.queue_message, message.size_bytes
    send(FileTransferPartAck(message.source_component_uuid, message.transfer_uuid, size, size))
    send(RemoveNotificationMessage(f"upload-{message.transfer_uuid}"))


class _Connection(ServerConnection):
    """Connection that is read at a bounded pace, and gives text messages as bytes.

    Attributes:
        crowd: all connections of a server that have to wait now.
    """

    crowd: ClassVar[set[ServerConnection]]
    _pace: Pace | None = None

    async def recv(self, decode: bool | None = None) -> Any:  # noqa: ANN401 (as its base)
        """Receive the next message, after a while if the client sends too many."""
        del decode  # a text message, of which viser has none, would end the connection
        message = await super().recv(decode=False)
        self._pace = self._pace or Pace(time.monotonic())
        wait = self._pace.wait(len(message), time.monotonic(), len(self.crowd))
        if wait and self.state is State.OPEN:  # the rest of a client that goes is soon done with
            self.crowd.add(self)
            try:
                await sleep(wait)
            finally:
                self.crowd.discard(self)
        return message


class _Decoder:
    """Decodes messages as viser does, but never fails."""

    def __init__(self, messages: type[Message]) -> None:
        self._messages = messages

    def deserialize(self, data: bytes) -> object:
        try:
            return self._messages.deserialize(data)
        except Exception as error:
            return Unreadable(error)


def _guarded_serving(serve: Callable[..., Any], guards: Guards) -> Callable[..., Any]:
    @functools.wraps(serve)
    def guarded(
        handler: Callable[[ServerConnection], Any],
        *arguments: Any,  # noqa: ANN401
        process_request: _Answer,
        **options: Any,  # noqa: ANN401
    ) -> Any:  # noqa: ANN401
        async def handle(connection: ServerConnection) -> None:
            if connection.subprotocol != _PROTOCOL:
                # viser would print a line; its page shows this reason.
                await connection.close(1002, f"Version mismatch. Server: {viser.__version__}")
                return
            try:
                await handler(connection)
            except Exception:
                _LOG.exception("A connection to a page has ended unexpectedly.")
                raise

        def answer(connection: ServerConnection, request: Request) -> Response | None:
            if refusal := guards.refused(request):
                return connection.respond(*refusal)
            try:
                return process_request(connection, request)
            except (OSError, ValueError):  # of a path that no file system takes
                return connection.respond(http.HTTPStatus.NOT_FOUND, "NOT FOUND\n")

        class Connection(_Connection):
            crowd: ClassVar[set[ServerConnection]] = set()

        return serve(
            handle,
            *arguments,
            process_request=answer,
            process_response=completing(guards.headers, guards.page),
            create_connection=Connection,
            max_queue=_WAITING,
            **options,
        )

    return guarded


def _guarded_server(server: type[Any], guards: Guards) -> type[Any]:
    class Guarded(server):
        def __init__(
            self,
            *arguments: Any,  # noqa: ANN401
            message_class: type[Message],
            **options: Any,  # noqa: ANN401
        ) -> None:
            super().__init__(*arguments, message_class=_Decoder(message_class), **options)
            attendants: dict[int, Attendant] = {}

            def arrive(connection: WebsockClientConnection) -> None:
                number = connection.client_id
                socket: ServerConnection = self._live_connections[number]
                attendants[number] = guards.attend(number, socket.transport.abort)
                _attend(connection, attendants[number])
                for buffer in (connection.get_message_buffer(), self.get_message_buffer()):
                    _keep_encodable(buffer)

            def leave(connection: WebsockClientConnection) -> None:
                attendants.pop(connection.client_id).leave()

            # Before those of viser, which make the client's handle.
            self.on_client_connect(arrive)
            self.on_client_disconnect(leave)

        async def _handle_incoming_message(self, client_id: int, message: Message) -> None:
            """Do nothing: all controls are those of single clients.

            viser would pass some messages on to all clients, and keep them for ever.
            """

    return Guarded


def _attend(connection: WebsockClientConnection, attendant: Attendant) -> None:
    """Let an attendant decide about a client's messages."""
    handle = connection._handle_incoming_message

    async def handle_admitted(client_id: Any, message: Any) -> None:  # noqa: ANN401
        if attendant.admits(message):
            try:
                await handle(client_id, message)
            except Exception as error:
                attendant.failed(error)

    vars(connection)["_handle_incoming_message"] = handle_admitted


@dataclass(frozen=True)
class _Sent:
    """Message that can be encoded, whatever text it holds by the time it is sent."""

    message: Message

    def as_serializable_dict(self, buffers: list[memoryview]) -> dict[str, Any]:
        return encodable(self.message.as_serializable_dict(buffers))


def _keep_encodable(buffer: AsyncMessageBuffer) -> None:
    """Let all messages of a buffer be encodable; one that is not would end the connection."""
    if "window_generator" in vars(buffer):
        return
    windows = buffer.window_generator

    async def encodable_windows(
        windows: AsyncGenerator[Sequence[Any], None],
    ) -> AsyncGenerator[list[_Sent], None]:
        try:
            async for window in windows:
                yield [_Sent(message) for message in window]
        finally:
            await windows.aclose()

    def begin(*arguments: Any, **options: Any) -> AsyncGenerator[list[_Sent], None]:  # noqa: ANN401
        return encodable_windows(windows(*arguments, **options))

    vars(buffer)["window_generator"] = begin
