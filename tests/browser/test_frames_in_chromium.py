"""Pages of others that show the app in a frame, in a real Chromium."""

import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any
from urllib.parse import unquote

import pytest
from playwright.sync_api import BrowserContext, Frame

from app.analysis.estimates import Estimates
from app.analysis.library import Library
from app.server.server import Server
from app.server.session import Shared
from app.session.reload import Reloads
from estimator import Parameters
from recordings import open_recording, sample_paths
from tests.browser.tab import until


class Embedding(BaseHTTPRequestHandler):
    """Pages that show the address in their query in a frame.

    Chromium lets no page of a public server show one of this machine.
    """

    def do_GET(self) -> None:
        address = unquote(self.path.partition("?")[2])
        body = f'<iframe src="{address}" width="800" height="600"></iframe>'.encode()
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, format: str, *args: Any) -> None:
        pass


@pytest.fixture(scope="module")
def embedder() -> Iterator[int]:
    """Port of a server with such pages."""
    with ThreadingHTTPServer(("127.0.0.1", 0), Embedding) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield server.server_address[1]
        server.shutdown()


def framed(context: BrowserContext, address: str, origin: str) -> Frame:
    """The frame of a page of this origin that shows an address."""
    page = context.new_page()
    page.goto(f"{origin}/?{address}", wait_until="load")
    (frame,) = page.main_frame.child_frames
    return frame


def test_no_page_of_others_shows_the_app_in_a_frame(
    context: BrowserContext, server: Server, embedder: int
):
    frame = framed(context, server.address, f"http://127.0.0.1:{embedder}")
    until(frame.page, lambda: frame.url.startswith("chrome-error:"))
    assert "refused to connect" in frame.evaluate("document.body.innerText")


def test_a_named_origin_shows_it_and_it_works_there(
    context: BrowserContext, estimates: Estimates, embedder: int
):
    named = f"http://localhost:{embedder}"
    library = Library(sample_paths(), open_recording)
    shared = Shared(library, estimates, Reloads(), Parameters())
    server = Server(shared, "127.0.0.1", 0, [named])
    try:
        frame = framed(context, server.address, named)
        # Its websocket comes from the server's own page.
        until(frame.page, lambda: frame.get_by_text("Moving").count() > 0, timeout=30.0)
        other = framed(context, server.address, f"http://127.0.0.1:{embedder}")
        until(other.page, lambda: other.url.startswith("chrome-error:"))
    finally:
        server.close()
