"""Web server with one session per browser client."""

import socket
from collections.abc import Sequence

import viser

from app.browser.guarded_server import GuardedServer
from app.browser.opening_card import front_page
from app.errors import InputError
from app.panels.page import TITLE
from app.scene.theme import apply_theme
from app.server.memory_release import MemoryRelease
from app.server.session import Session, Shared

_PANEL_WIDTH = 360  # pixels
_ANY = {"0.0.0.0": "127.0.0.1", "::": "::1", "": "127.0.0.1"}
"""{wildcard address: the address that browsers on this machine use}."""


class Server:
    """Serves sessions until it is closed.

    Args:
        shared: parts common to all sessions.
        host: address to listen on.
        port: port to listen on, 0 for any free one.
        embedders: origins whose pages may show the page in a frame.

    Raises:
        InputError: the port is in use, or this machine has no such address.
    """

    def __init__(self, shared: Shared, host: str, port: int, embedders: Sequence[str] = ()) -> None:
        _check_free(host, port)
        self._sessions: dict[int, Session] = {}
        self._memory = MemoryRelease()
        self._server = GuardedServer(
            host, port, TITLE, embedders, lambda html: front_page(html, TITLE)
        )
        self.host, self.port = host, self._server.get_port()
        apply_theme(self._server.gui, dark=False)
        self._server.gui.main_panel.dock_right()
        self._server.gui.main_panel.set_width(_PANEL_WIDTH)

        # Coroutines run in viser's event loop in order, so that a client's disconnect cannot
        # overtake its connect.
        @self._server.on_client_connect
        async def _(client: viser.ClientHandle) -> None:
            self._sessions[client.client_id] = Session(client, shared)

        @self._server.on_client_disconnect
        async def _(client: viser.ClientHandle) -> None:
            if session := self._sessions.pop(client.client_id, None):
                session.close()
                self._memory.soon()

    @property
    def address(self) -> str:
        """Address of the page for a browser on this machine."""
        return self._address(_ANY.get(self.host, self.host))

    @property
    def address_for_others(self) -> str:
        """Address of the page for other machines, as far as this one knows its own."""
        return self._address(_own_address(self.host) if self.host in _ANY else self.host)

    def _address(self, host: str) -> str:
        return f"http://[{host}]:{self.port}" if ":" in host else f"http://{host}:{self.port}"

    def close(self) -> None:
        """End all sessions and free the port."""
        sessions = list(self._sessions.values())
        for session in sessions:
            session.close()
        for session in sessions:
            session.join(timeout=5.0)
        self._memory.close()
        self._server.stop()


def _own_address(host: str) -> str:
    """This machine's address towards others, or its host name without a network."""
    version_6 = host == "::"
    family = socket.AF_INET6 if version_6 else socket.AF_INET
    try:
        with socket.socket(family, socket.SOCK_DGRAM) as probe:
            # An address reserved for documentation; connecting a datagram socket sends nothing.
            probe.connect(("2001:db8::1" if version_6 else "192.0.2.1", 9))
            return str(probe.getsockname()[0])
    except OSError:
        return socket.gethostname()


def _check_free(host: str, port: int) -> None:
    """Raise InputError if the port is not available; viser would silently take another one."""
    try:
        family, kind, protocol, _, address = socket.getaddrinfo(
            host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
        )[0]
        with socket.socket(family, kind, protocol) as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            probe.bind(address)
    except OSError as error:
        raise InputError(
            f"Nothing can be served at {host}, port {port} ({error.strerror}); "
            f"choose another with --host and --port."
        ) from error
