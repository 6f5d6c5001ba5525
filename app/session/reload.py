"""Sessions that clients have left, kept for a reload of their page."""

import threading
from collections import OrderedDict

from app.session.links import SavedSession


class Reloads:
    """Saved sessions under tokens that browsers hold; the oldest are forgotten.

    A tab keeps nothing but its token, so nothing that it sends has to be trusted, and the copy of
    a tab, which finds the token of a session that goes on, begins anew.
    """

    def __init__(self, size: int = 64) -> None:
        self._size = size
        self._lock = threading.Lock()
        self._left: OrderedDict[str, SavedSession] = OrderedDict()

    def keep(self, token: str, left: SavedSession) -> None:
        """Keep an ended session."""
        with self._lock:
            self._left[token] = left
            while len(self._left) > self._size:
                self._left.popitem(last=False)

    def take(self, token: str | None) -> SavedSession | None:
        """Hand out the session that was left under a token, once; None where there is none."""
        with self._lock:
            return self._left.pop(token, None) if token is not None else None
