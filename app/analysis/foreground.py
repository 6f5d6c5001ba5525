"""Priority of work that a user waits for over background work."""

import threading
import time
from types import TracebackType


class Foreground:
    """Context for work that a user waits for; background threads pause while it runs."""

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

    def wait_until_quiet(self, seconds: float, at_most: float = threading.TIMEOUT_MAX) -> bool:
        """Wait until no foreground work has run for some time.

        Args:
            seconds: without foreground work that end the wait.
            at_most: seconds after which the wait ends in any case, since dragging a slider, or
                playing a recording longer than the cache, never pauses.

        Returns:
            Whether it is quiet.
        """
        end = time.monotonic() + at_most
        with self._changed:
            while (now := time.monotonic()) < end:
                quiet = self._ended + seconds
                if not self._running and now >= quiet:
                    return True
                self._changed.wait(
                    min(end - now, threading.TIMEOUT_MAX if self._running else quiet - now)
                )
        return False
