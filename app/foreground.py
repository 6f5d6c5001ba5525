"""Who waits for what: work that nobody waits for stands back."""

import threading
import time
from types import TracebackType


class Foreground:
    """A context for work that a person waits for; others can wait until there is none."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._running = 0
        self._ended = float("-inf")

    def __enter__(self) -> None:
        with self._changed:
            self._running += 1

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        with self._changed:
            self._running -= 1
            self._ended = time.monotonic()
            self._changed.notify_all()

    def wait_until_quiet(self, seconds: float) -> None:
        """Wait until nothing has run for this long; a slider that is moved is never quiet."""
        with self._changed:
            while True:
                left = self._ended + seconds - time.monotonic()
                if self._running:
                    self._changed.wait()
                elif left > 0:
                    self._changed.wait(left)
                else:
                    return
