"""Ended sessions, kept for a reload of their pages."""

import threading
from collections import OrderedDict

from app.session.links import SavedSession


class Reloads:
    """Bounded store of saved sessions by the tokens of browser tabs.

    A tab stores only its token, so no state from a browser needs to be trusted. A duplicated tab
    has the token of a running session, which is not stored, and starts a new one.
    """

    def __init__(self, size: int = 64) -> None:
        self._size = size
        self._lock = threading.Lock()
        self._saved: OrderedDict[str, SavedSession] = OrderedDict()

    def keep(self, token: str, saved: SavedSession) -> None:
        """Store an ended session; the oldest is dropped when the store is full."""
        with self._lock:
            self._saved[token] = saved
            while len(self._saved) > self._size:
                self._saved.popitem(last=False)

    def take(self, token: str | None) -> SavedSession | None:
        """Remove and return the session of a token, None without one."""
        with self._lock:
            return self._saved.pop(token, None) if token is not None else None
