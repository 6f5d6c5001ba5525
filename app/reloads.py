"""What a client left behind, for when its page is loaded again."""

import threading
from collections import OrderedDict
from dataclasses import dataclass

from estimator import Parameters


@dataclass(frozen=True)
class Left:
    """Where a session was when it ended.

    Attributes:
        label: of the recording in the list.
        frame: that was shown.
        parameters: that were set.
    """

    label: str
    frame: int
    parameters: Parameters


class Reloads:
    """Keeps what ended sessions left, under tokens that browsers hold; the oldest are forgotten.

    The browser keeps nothing but its token, so nothing that it sends has to be trusted, and a
    second tab, which finds the token of a session that goes on, begins anew.
    """

    def __init__(self, size: int = 64) -> None:
        self._size = size
        self._lock = threading.Lock()
        self._left: OrderedDict[str, Left] = OrderedDict()

    def leave(self, token: str, left: Left) -> None:
        """Keep what a session left."""
        with self._lock:
            self._left[token] = left
            while len(self._left) > self._size:
                self._left.popitem(last=False)

    def take(self, token: str | None) -> Left | None:
        """Hand out what was left under a token, once; None where there is nothing."""
        with self._lock:
            return self._left.pop(token, None) if token is not None else None
