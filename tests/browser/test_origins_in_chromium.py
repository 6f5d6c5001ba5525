import socket
from pathlib import Path

import pytest
from playwright.sync_api import BrowserContext

from app.analysis.estimates import Estimates
from app.analysis.library import Library
from app.server.server import Server
from app.server.session import Shared
from app.session.reload import Reloads
from estimator import Parameters
from recordings import open_recording
from tests.browser.tab import Tab

_CONNECT = """address => new Promise(done => {
  const socket = new WebSocket(address, ["viser-v1.1.1"]);
  socket.onopen = () => done("let in");
  socket.onerror = () => done("refused");
})"""


def own_address() -> str:
    """An address of this machine that is not a loopback one."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("192.0.2.1", 9))  # nothing is sent: the system only chooses a way out
        except OSError:
            pytest.skip("this machine has no address but its loopback one")
        return probe.getsockname()[0]


def test_the_page_works_by_the_machines_address_and_foreign_pages_cannot_connect(
    context: BrowserContext, recordings_folder: Path, estimates: Estimates
):
    address = own_address()
    library = Library([recordings_folder], open_recording)
    server = Server(Shared(library, estimates, Reloads(), Parameters()), "0.0.0.0", 0)
    try:
        exposed = f"{address}:{server.port}"
        tab = Tab(context, f"http://{exposed}")  # waits for arrows
        assert tab.page.evaluate(_CONNECT, f"ws://{exposed}") == "let in"
        assert tab.page.evaluate(_CONNECT, f"ws://127.0.0.1:{server.port}") == "refused"

        foreign = context.new_page()
        foreign.route("http://evil.example/**", lambda route: route.fulfill(body="<p>evil</p>"))
        foreign.goto("http://evil.example/")
        assert foreign.evaluate(_CONNECT, f"ws://{exposed}") == "refused"
        assert foreign.evaluate(_CONNECT, f"ws://127.0.0.1:{server.port}") == "refused"
    finally:
        server.close()
