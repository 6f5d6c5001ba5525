"""Pace at which the messages of one client are read, so that none keeps others waiting."""

_PER_SECOND = 300.0
_AT_ONCE = 1000.0
_BYTES = 262_144  # that cost as much as a message


class Pace:
    """Budget of messages that is refilled with time; who exceeds it has to wait.

    A page sends tens of messages a second while somebody drags a slider or turns the camera.

    Args:
        now: seconds of a monotonic clock.
    """

    def __init__(self, now: float) -> None:
        self._left, self._then = _AT_ONCE, now

    def wait(self, size: int, now: float) -> float:
        """Seconds to wait before the next message is read.

        Args:
            size: of the message that has been read, in bytes.
            now: seconds of a monotonic clock.
        """
        self._left = min(self._left + (now - self._then) * _PER_SECOND, _AT_ONCE)
        self._then = now
        self._left -= 1.0 + size / _BYTES
        return max(-self._left / _PER_SECOND, 0.0)
