"""Pace at which the messages of clients are read, so that no flood keeps others waiting."""

_PER_SECOND = 300.0
_AT_ONCE = 300.0
_BYTES = 262_144  # that cost as much as a message


class Pace:
    """Budget of one client's messages that is refilled with time; who exceeds it has to wait.

    A page sends tens of messages a second while somebody drags a slider or turns the camera.

    Args:
        now: seconds of a monotonic clock.
    """

    def __init__(self, now: float) -> None:
        self._left, self._then = _AT_ONCE, now

    def wait(self, size: int, now: float, waiting: int = 0) -> float:
        """Seconds to wait before the next message is read.

        Args:
            size: of the message that has been read, in bytes.
            now: seconds of a monotonic clock.
            waiting: other clients who have to wait; all who do share what one may send.
        """
        shared = _PER_SECOND / (1 + waiting)
        rate = _PER_SECOND if self._left >= 0.0 else shared
        self._left = min(self._left + (now - self._then) * rate, _AT_ONCE)
        self._then = now
        self._left -= 1.0 + size / _BYTES
        return max(-self._left / shared, 0.0)
