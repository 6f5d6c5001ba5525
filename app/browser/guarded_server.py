"""viser server that refuses requests of foreign web pages and prints nothing."""

import contextlib
import io
import ipaddress
import logging
import socket
import threading
from typing import Any
from urllib.parse import urlsplit

import viser
from websockets.http11 import Request

from app.browser.internals import CONNECTION_LOGGER, guarding_requests

_starting = threading.Lock()


class GuardedServer(viser.ViserServer):
    """Server that rejects requests of pages of other origins.

    Requests without an origin, such as those of programs, are answered.

    Args:
        host: address to listen on.
        port: port to listen on, 0 for any free one.
        label: title of the panel.
    """

    def __init__(self, host: str, port: int, label: str | None = None) -> None:
        logging.getLogger(CONNECTION_LOGGER).setLevel(logging.CRITICAL)
        guard = guarding_requests(lambda request: _refusal(request, host))
        with _starting, _quiet(), guard:
            super().__init__(host=host, port=port, label=label, verbose=False)

    @property
    def camera(self) -> viser.InitialCameraConfig:
        """Initial camera of clients, which lets a scene be drawn on the server."""
        return self.initial_camera

    def stop(self) -> None:
        """Close all connections and free the port."""
        with _starting, _quiet():
            super().stop()

    def request_share_url(self, verbose: bool = True) -> None:
        """Do nothing: any page could call it, and it would make this port public."""


def is_foreign(origin: str, addressed: str | None, host: str) -> bool:
    """Whether an origin is foreign, that is, not a page of this server.

    A page of this server was loaded from the address it now connects to. That address must be an IP
    address or a name of this machine: other names may have been pointed at it (DNS rebinding).

    Args:
        origin: of the page, such as http://127.0.0.1:8080.
        addressed: the request's Host header, such as 127.0.0.1:8080.
        host: address that the server listens on.
    """
    parts = urlsplit(origin)
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


def _refusal(request: Request, host: str) -> str | None:
    """Reason to refuse a request to the server at `host`, None to answer it."""
    headers = request.headers
    hosts = headers.get_all("Host")
    addressed = hosts[0] if len(hosts) == 1 else None
    if any(is_foreign(origin, addressed, host) for origin in headers.get_all("Origin")):
        return "This server answers the pages that it sent itself, and no others.\n"
    return None


def _quiet() -> contextlib.AbstractContextManager[Any]:
    # viser prints messages at start and stop; the commands print what users need.
    return contextlib.redirect_stdout(io.StringIO())
