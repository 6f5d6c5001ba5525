import contextlib
import inspect
import logging
import socket
import threading
import time

import msgspec
import pytest
import viser
import websockets.asyncio.server as websocket_server
from viser import _messages as messages
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect
from websockets.typing import Origin, Subprotocol

from app.browser.guarded_server import GuardedServer, is_foreign
from tests.app.waiting import until
from tests.app.wire_client import WireClient

VERSION = Subprotocol(f"viser-v{viser.__version__}")


@pytest.fixture
def server():
    server = GuardedServer("127.0.0.1", 0)
    yield server
    server.stop()


def greeted(host: str, port: int, origin: str | None) -> bool:
    """Whether a websocket client of this origin is let in, and gets what all pages get."""
    asked = Origin(origin) if origin else None
    address = f"ws://{host}:{port}"
    try:
        with connect(address, origin=asked, subprotocols=[VERSION], proxy=None) as connection:
            return len(connection.recv(timeout=10)) > 0
    except InvalidStatus as refusal:
        return refusal.response.status_code != 403


def test_only_its_own_pages_and_programs_are_let_in(server: GuardedServer):
    port = server.get_port()
    assert greeted("127.0.0.1", port, None)
    assert greeted("127.0.0.1", port, f"http://127.0.0.1:{port}")
    assert greeted("localhost", port, f"http://localhost:{port}")
    for foreign in (
        "http://evil.example",
        f"http://127.0.0.1:{port + 1}",
        f"http://localhost:{port}",
        f"http://evil.example:{port}",
        "null",
    ):
        assert not greeted("127.0.0.1", port, foreign), foreign
    assert not server.get_clients()


def test_a_name_that_points_at_this_machine_does_not_make_a_page_ours():
    assert is_foreign("http://evil.example:8080", "evil.example:8080", "127.0.0.1")
    assert not is_foreign("http://lab.example:8080", "lab.example:8080", "lab.example")
    assert not is_foreign("http://192.0.2.7:8080", "192.0.2.7:8080", "0.0.0.0")
    assert not is_foreign("http://[::1]:8080", "[::1]:8080", "::1")
    own = socket.gethostname()
    assert not is_foreign(f"http://{own}:8080", f"{own}:8080", "0.0.0.0")
    assert is_foreign("http://127.0.0.1:8080", None, "127.0.0.1")
    assert is_foreign("http://[bad", "[bad", "127.0.0.1")


def test_other_servers_of_the_process_are_left_as_they_were(server: GuardedServer):
    assert inspect.isclass(websocket_server.serve)


def test_a_connection_that_asks_for_nothing_is_not_complained_of(
    server: GuardedServer, caplog: pytest.LogCaptureFixture
):
    # viser begins to filter such complaints with the first request that it answers.
    logging.getLogger("websockets.server").filters.clear()
    port = server.get_port()
    with socket.create_connection(("127.0.0.1", port), timeout=5):
        pass
    assert greeted("127.0.0.1", port, None)
    assert not [record for record in caplog.records if record.levelno > logging.INFO]


def answer(port: int, *headers: str, path: str = "/") -> tuple[int, dict[str, str]]:
    """Status and headers, by their names in small letters, of a raw request."""
    lines = (f"GET {path} HTTP/1.1", f"Host: 127.0.0.1:{port}", *headers, "", "")
    with socket.create_connection(("127.0.0.1", port), timeout=10) as connection:
        connection.sendall("\r\n".join(lines).encode())
        head = b""
        while b"\r\n\r\n" not in head:
            received = connection.recv(65536)
            assert received, head
            head += received
    status, *fields = head.partition(b"\r\n\r\n")[0].decode().split("\r\n")
    pairs = (field.partition(": ") for field in fields)
    return int(status.split()[1]), {name.lower(): value for name, _, value in pairs}


UPGRADE = ("Upgrade: websocket", "Connection: Upgrade", "Sec-WebSocket-Version: 13")


def test_no_answer_may_be_framed(server: GuardedServer):
    port = server.get_port()
    for headers, path, status in (
        ((), "/", 200),
        (("Accept-Encoding: gzip",), "/?link=abc", 200),
        ((), "/nothing", 404),
        ((), "/../../etc/passwd", 404),
        ((), "/" + "a" * 300, 404),
        ((), "/%00", 404),
        ((), "/" + "a" * 4000, 414),
        (("Origin: http://evil.example",), "/", 403),
        (("Origin: http://[bad",), "/", 403),
        (UPGRADE, "/", 400),  # without a key
        ((*UPGRADE, "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA=="), "/", 101),
    ):
        found, given = answer(port, *headers, path=path)
        assert found == status, (headers, path[:20])
        assert given["content-security-policy"] == "frame-ancestors 'none'"
        assert given["x-frame-options"] == "DENY"


def test_named_origins_may_frame_the_page():
    server = GuardedServer("127.0.0.1", 0, embedders=["https://a.example", "http://b.example:81"])
    try:
        status, given = answer(server.get_port())
    finally:
        server.stop()
    assert status == 200
    policy = "frame-ancestors https://a.example http://b.example:81"
    assert given["content-security-policy"] == policy
    assert "x-frame-options" not in given


@pytest.fixture
def address(server: GuardedServer) -> str:
    return f"http://127.0.0.1:{server.get_port()}"


def rubbish(uuid: str) -> list[bytes | str]:
    """Messages that viser decodes or handles with an exception."""
    fields = (
        {"uuid": uuid, "updates": {"nothing": 1}},
        {"uuid": uuid, "updates": {"value": "no number"}},
        {"uuid": uuid, "updates": {"value": [1]}},
        {"uuid": uuid, "updates": 5},
        {"uuid": [uuid], "updates": {"value": 1}},
        {"wrong": 5},
    )
    packed = [msgspec.msgpack.encode({"type": "GuiUpdateMessage", **field}) for field in fields]
    camera = {"type": "ViewerCameraMessage", "wxyz": [1], "position": "x", "fov": None}
    deep = b"\x91" * 100_000
    return [*packed, msgspec.msgpack.encode(camera), deep, b"\xff\x00", b"", "text", "[]"]


def test_rubbish_prints_nothing_ends_no_session_and_is_told_in_one_line(
    server: GuardedServer, address: str, caplog: pytest.LogCaptureFixture, capfd
):
    numbers = []

    @server.on_client_connect
    async def _(client: viser.ClientHandle) -> None:
        numbers.append(client.gui.add_number("k", 1.0))

    with WireClient(address) as client:
        until(lambda: client.has("k"))
        sent = rubbish(numbers[0]._impl.uuid)
        for data in sent:
            client._socket.send(data)
        client.change("k", 2.0)
        until(lambda: numbers[0].value == 2.0)
    until(lambda: [r for r in caplog.records if r.levelno >= logging.WARNING])
    (line,) = [r.getMessage() for r in caplog.records if r.levelno >= logging.WARNING]
    assert line.startswith(f"One client sent {len(sent)} messages that could not be understood (")
    assert capfd.readouterr() == ("", "")


def test_a_client_that_sends_rubbish_on_and_on_is_disconnected(
    server: GuardedServer, address: str, caplog: pytest.LogCaptureFixture
):
    with WireClient(address) as client:
        with contextlib.suppress(ConnectionClosed):
            for _ in range(1_000_000):
                client._socket.send(b"rubbish")
        until(lambda: [r for r in caplog.records if r.levelno >= logging.WARNING])
    (line,) = [r.getMessage() for r in caplog.records if r.levelno >= logging.WARNING]
    assert line.startswith("One client sent 100 messages")
    assert line.endswith("Connections that were ended for that: 1.")
    with WireClient(address):
        until(lambda: len(server.get_clients()) == 1)


def test_a_flood_is_slowed_down_and_others_are_served(server: GuardedServer, address: str):
    handled, numbers = [], []

    @server.on_client_connect
    async def _(client: viser.ClientHandle) -> None:
        numbers.append(number := client.gui.add_number("k", 1.0))

        @number.on_update
        async def _(event: viser.GuiEvent) -> None:
            handled.append(event.client_id)

    with WireClient(address) as client:
        until(lambda: client.has("k"))
        began = time.monotonic()

        def flood() -> None:
            k = 0
            while time.monotonic() < began + 1.0:
                client.change("k", k := k + 1)

        thread = threading.Thread(target=flood)
        thread.start()
        time.sleep(0.5)
        with WireClient(address) as other:
            until(lambda: other.has("k"))
        thread.join()
        assert len(handled) <= 300 + 300 * (time.monotonic() - began + 0.1)
        ends = time.monotonic()
        server.stop()  # what is on the way of the flood keeps nobody waiting
        assert time.monotonic() - ends < 10.0


def test_what_is_on_no_clients_own_page_does_nothing(server: GuardedServer, address: str):
    shared = server.gui.add_number("shared", 1.0)
    with WireClient(address) as client:
        until(lambda: client.has("shared"))
        buffer = server._websock_server._broadcast_buffer
        before = len(buffer.message_from_id)
        client.change("shared", 7.0)
        for k in range(20):
            client.send(messages.GuiFormDirtyMessage(f"u{k}"))
        with WireClient(address) as other:
            until(lambda: other.has("shared"))
        assert shared.value == 1.0
        assert len(buffer.message_from_id) == before


def test_text_that_cannot_be_encoded_ends_no_connection(server: GuardedServer, address: str):
    told = []

    @server.on_client_connect
    async def _(client: viser.ClientHandle) -> None:
        client.add_notification("\ud800", "lone \udfff")
        client.gui.add_dropdown("d", ("fine", "\udcff.mcap"))
        client.gui.add_html("").content = "<b>\ud800</b>"
        client.gui.add_number("last", 1.0)

    def listen(_, message):
        if message["type"] == "NotificationShowMessage":
            told.append((message["props"]["title"], message["props"]["body"]))

    server.gui.add_markdown("for all: \ud800")
    with WireClient(address, listen) as client:
        until(lambda: client.has("last"))
        assert told == [("\ufffd", "lone \ufffd")]
        client._socket.ping().wait(5)


def test_a_client_without_viser_s_protocol_prints_nothing(server: GuardedServer, capfd):
    with connect(f"ws://127.0.0.1:{server.get_port()}", proxy=None) as connection:
        with pytest.raises(ConnectionClosed) as closed:
            connection.recv(timeout=10)
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == 1002
    assert capfd.readouterr() == ("", "")


def test_incomplete_uploads_do_not_stay_in_memory(server: GuardedServer, address: str):
    buttons, handles = [], []

    @server.on_client_connect
    async def _(client: viser.ClientHandle) -> None:
        handles.append(client)
        buttons.append(client.gui.add_upload_button("up"))

    def kept() -> int:
        states = handles[0].gui._current_file_upload_states.values()
        return sum(len(part) for state in states for part in state["parts"].values())

    with WireClient(address) as client:
        until(lambda: buttons)
        uuid = buttons[0]._impl.uuid
        client.send(messages.FileTransferStartUpload(uuid, "a", "a", "", 100, 100_000_000))
        client.send(messages.FileTransferStartUpload(uuid, "b", "b", "", 2, 900_000))
        client.send(messages.FileTransferStartUpload(uuid, "c", "c", "", 2, 900_000))
        for name in "abc":
            for k in range(20):
                client.send(messages.FileTransferPart(uuid, name, k, bytes(450_000)))
        client.send(messages.FileTransferStartUpload(uuid, "d", "d", "", 1, 4))
        client.send(messages.FileTransferPart(uuid, "d", 0, b"last"))
        until(lambda: buttons[0].value.content == b"last")
        assert kept() == 0
