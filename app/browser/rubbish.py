"""Log of messages that could not be understood, one line for many."""

import logging
import threading
import time
from collections.abc import Callable

_LOG = logging.getLogger(__name__)
_PAUSE = 60.0  # seconds between two lines


class RubbishLog:
    """Tells of clients that sent what could not be understood: at once, then once a minute.

    Args:
        clock: seconds, monotonic.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._lock = threading.Lock()
        self._told = -_PAUSE
        self._clients = self._messages = self._ended = 0
        self._last = ""

    def note(self, messages: int, last: str, *, ended: bool) -> None:
        """Note a client that has gone.

        Args:
            messages: of it that could not be understood.
            last: the last one's error.
            ended: whether its connection was ended for that.
        """
        with self._lock:
            self._clients += 1
            self._messages += messages
            self._ended += ended
            self._last = last
            if self._clock() >= self._told + _PAUSE:
                self._tell()

    def close(self) -> None:
        """Tell the rest."""
        with self._lock:
            if self._clients:
                self._tell()

    def _tell(self) -> None:
        who = "One client" if self._clients == 1 else f"{self._clients:,} clients"
        what = "1 message" if self._messages == 1 else f"{self._messages:,} messages"
        ended = f" Connections that were ended for that: {self._ended:,}." if self._ended else ""
        _LOG.warning(
            "%s sent %s that could not be understood (the last: %s).%s",
            *(who, what, self._last, ended),
        )
        self._told = self._clock()
        self._clients = self._messages = self._ended = 0
