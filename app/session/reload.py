"""What a client left behind, for when its page is loaded again."""

import threading
from collections import OrderedDict

from app.session.links import Place


class Reloads:
    """Keeps what ended sessions left, under tokens that browsers hold; the oldest are forgotten.

    A tab keeps nothing but its token, so nothing that it sends has to be trusted, and the copy of
    a tab, which finds the token of a session that goes on, begins anew.
    """

    def __init__(self, size: int = 64) -> None:
        self._size = size
        self._lock = threading.Lock()
        self._left: OrderedDict[str, Place] = OrderedDict()

    def leave(self, token: str, left: Place) -> None:
        """Keep what a session left."""
        with self._lock:
            self._left[token] = left
            while len(self._left) > self._size:
                self._left.popitem(last=False)

    def take(self, token: str | None) -> Place | None:
        """Hand out what was left under a token, once; None where there is nothing."""
        with self._lock:
            return self._left.pop(token, None) if token is not None else None
