import socket
from typing import Any

import pytest
from viser import _messages

from app.analysis.estimates import Estimates
from app.analysis.library import Library
from app.errors import InputError
from app.server.server import Server, _own_address
from app.server.session import Shared
from app.session.reload import Reloads
from estimator import Parameters
from tests.app.fake_recordings import fake_recording


@pytest.fixture
def shared(tmp_path):
    library = Library([tmp_path], lambda path: fake_recording(name=path.stem))
    return Shared(library, Estimates(), Reloads(), Parameters())


@pytest.fixture
def server(shared):
    server = Server(shared, "127.0.0.1", 0)
    yield server
    server.close()


def test_it_listens_on_this_machine_alone(server):
    assert server.address == f"http://127.0.0.1:{server.port}"
    with socket.create_connection(("127.0.0.1", server.port), timeout=5):
        pass
    assert server._server.get_host() == "127.0.0.1"


def test_no_page_can_make_it_public(server, monkeypatch):
    def tunnel(*_: Any):
        pytest.fail("a tunnel was opened")

    monkeypatch.setattr("viser._viser.ViserTunnel", tunnel)
    handlers = server._server._websock_server._incoming_handlers[_messages.ShareUrlRequest]
    for handler in handlers:
        handler(1, _messages.ShareUrlRequest())
    server._server._thread_executor.shutdown(wait=True)
    assert server._server._share_tunnel is None
    assert server._server.request_share_url() is None


def test_a_port_in_use_is_not_swapped_for_another(server, shared):
    with pytest.raises(InputError, match=f"port {server.port}"):
        Server(shared, "127.0.0.1", server.port)


def test_it_says_nothing_on_the_terminal_and_frees_its_port(shared, capfd):
    server = Server(shared, "127.0.0.1", 0)
    port = server.port
    server.close()
    Server(shared, "127.0.0.1", port).close()
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize(("host", "shown"), [("127.0.0.1", "127.0.0.1"), ("0.0.0.0", "10.1.2.3")])
def test_others_are_told_an_address_that_is_not_everybodys(shared, monkeypatch, host, shown):
    monkeypatch.setattr("app.server.server._own_address", lambda _: "10.1.2.3")
    server = Server(shared, host, 0)
    try:
        assert server.address_for_others == f"http://{shown}:{server.port}"
        assert server.address == f"http://127.0.0.1:{server.port}"
    finally:
        server.close()


def test_a_machine_without_a_network_tells_its_name(monkeypatch):
    def unreachable(*_: Any):
        raise OSError(101, "Network is unreachable")

    monkeypatch.setattr(socket.socket, "connect", unreachable)
    assert _own_address("0.0.0.0") == socket.gethostname()
