"""viser server that bears foreign web pages and hostile clients, and prints nothing."""

import contextlib
import io
import ipaddress
import logging
import socket
import threading
import warnings
from collections.abc import Callable, Mapping, Sequence
from http import HTTPStatus
from typing import Any
from urllib.parse import urlsplit

import viser
from websockets.http11 import Request

from app.browser.connections import (
    CLOSED_CONNECTION,
    CONNECTION_LOGGER,
    ODD_MESSAGE,
    Guards,
    guarding,
)
from app.browser.internals import keep_icons_open
from app.browser.rubbish import RubbishLog
from app.browser.visitor import Visitor

_LONGEST_PATH = 1000  # characters, without the query; the longest of viser's page has fewer than 20
_starting = threading.Lock()


class GuardedServer(viser.ViserServer):
    """Server that rejects requests of pages of other origins, and may not be framed by them.

    Requests without an origin, such as those of programs, are answered. What a client sends can
    neither print tracebacks, keep others waiting nor fill the memory.

    Args:
        host: address to listen on.
        port: port to listen on, 0 for any free one.
        label: title of the panel.
        embedders: origins whose pages may show this server's in a frame.
        page: changes the page that viser sends.
    """

    def __init__(
        self,
        host: str,
        port: int,
        label: str | None = None,
        embedders: Sequence[str] = (),
        page: Callable[[bytes], bytes] = lambda html: html,
    ) -> None:
        keep_icons_open()
        logging.getLogger(CONNECTION_LOGGER).setLevel(logging.CRITICAL)
        for message in (CLOSED_CONNECTION, ODD_MESSAGE):
            warnings.filterwarnings("ignore", message=message)
        self._rubbish = RubbishLog()
        guards = Guards(
            refused=lambda request: _refusal(request, host),
            headers=framing_headers(embedders),
            attend=self._attend,
            page=page,
        )
        with _starting, _quiet(), guarding(guards):
            super().__init__(host=host, port=port, label=label, verbose=False)

    def _attend(self, number: int, end: Callable[[], None]) -> Visitor:
        return Visitor(lambda: self.get_clients().get(number), end, self._rubbish)

    @property
    def camera(self) -> viser.InitialCameraConfig:
        """Initial camera of clients, which lets a scene be drawn on the server."""
        return self.initial_camera

    def stop(self) -> None:
        """Close all connections and free the port."""
        with _starting, _quiet():
            super().stop()
        self._rubbish.close()

    def request_share_url(self, verbose: bool = True) -> None:
        """Do nothing: any page could call it, and it would make this port public."""


def framing_headers(embedders: Sequence[str]) -> Mapping[str, str]:
    """HTTP headers by which browsers show a page in frames of these origins alone."""
    if embedders:
        # The older X-Frame-Options knows no list; browsers that know both follow the newer one.
        return {"Content-Security-Policy": f"frame-ancestors {' '.join(embedders)}"}
    return {
        "Content-Security-Policy": "frame-ancestors 'none'",
        "X-Frame-Options": "DENY",
    }


def is_foreign(origin: str, addressed: str | None, host: str) -> bool:
    """Whether an origin is foreign, that is, not a page of this server.

    A page of this server was loaded from the address it now connects to. That address must be an IP
    address or a name of this machine: other names may have been pointed at it (DNS rebinding).

    Args:
        origin: of the page, such as http://127.0.0.1:8080.
        addressed: the request's Host header, such as 127.0.0.1:8080.
        host: address that the server listens on.
    """
    try:
        parts = urlsplit(origin)
    except ValueError:  # of a bracket that is not closed, for one
        return True
    if addressed is None or parts.netloc.lower() != addressed.lower():
        return True
    name = (parts.hostname or "").lower().rstrip(".")
    own = socket.gethostname().lower()
    return not (
        name in {"localhost", host.lower(), own, f"{own}.local", socket.getfqdn().lower()}
        or name.endswith(".localhost")
        or _is_address(name)
    )


def _is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


def _refusal(request: Request, host: str) -> tuple[HTTPStatus, str] | None:
    """Why to refuse a request to the server at `host`, None to answer it."""
    headers = request.headers
    hosts = headers.get_all("Host")
    addressed = hosts[0] if len(hosts) == 1 else None
    if any(is_foreign(origin, addressed, host) for origin in headers.get_all("Origin")):
        said = "This server answers the pages that it sent itself, and no others.\n"
        return HTTPStatus.FORBIDDEN, said
    if len(request.path.partition("?")[0]) > _LONGEST_PATH:
        return HTTPStatus.REQUEST_URI_TOO_LONG, "There is no page at so long a path.\n"
    return None


def _quiet() -> contextlib.AbstractContextManager[Any]:
    # viser prints messages at start and stop; the commands print what users need.
    return contextlib.redirect_stdout(io.StringIO())
