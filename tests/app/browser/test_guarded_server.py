import inspect
import logging
import socket

import pytest
import viser
import websockets.asyncio.server as websocket_server
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect
from websockets.typing import Origin, Subprotocol

from app.browser.guarded_server import GuardedServer, is_foreign

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
