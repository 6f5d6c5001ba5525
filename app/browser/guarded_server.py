"""viser's server, quiet on the terminal, which refuses what other web pages send."""

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
    """Server that answers its own pages and programs, and no foreign page.

    Args:
        host: address to listen at.
        port: port to listen at, 0 for any that is free.
        label: title of the panel.
    """

    def __init__(self, host: str, port: int, label: str | None = None) -> None:
        logging.getLogger(CONNECTION_LOGGER).setLevel(logging.CRITICAL)
        guard = guarding_requests(lambda request: _refusal(request, host))
        with _starting, _quiet(), guard:
            super().__init__(host=host, port=port, label=label, verbose=False)

    @property
    def camera(self) -> viser.InitialCameraConfig:
        """Camera that clients begin with; with it, a scene can be drawn on the server."""
        return self.initial_camera

    def stop(self) -> None:
        """Close all connections and free the port."""
        with _starting, _quiet():
            super().stop()

    def request_share_url(self, verbose: bool = True) -> None:
        """Refuse: any page could ask for it, and it would make this port public."""


def is_foreign(origin: str, addressed: str | None, host: str) -> bool:
    """Whether a page of this origin is none of this server's.

    A page is this server's where it was loaded from the address at which it connects now. Names
    that others can point at this machine, to make its pages look like ours, are no such address.

    Args:
        origin: of the page, such as http://127.0.0.1:8080.
        addressed: the request's Host header, such as 127.0.0.1:8080.
        host: address that the server listens at.
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
    """Why a request is refused by the server at an address, None where it is answered."""
    headers = request.headers
    hosts = headers.get_all("Host")
    addressed = hosts[0] if len(hosts) == 1 else None
    if any(is_foreign(origin, addressed, host) for origin in headers.get_all("Origin")):
        return "This server answers the pages that it sent itself, and no others.\n"
    return None


def _quiet() -> contextlib.AbstractContextManager[Any]:
    # viser greets and takes its leave on the terminal; what people need, the commands tell them.
    return contextlib.redirect_stdout(io.StringIO())
