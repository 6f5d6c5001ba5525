"""Which frame is due: playback in the recording's own time."""

import bisect
from collections.abc import Iterable


class PlaybackClock:
    """Plays a recording's stamps against a monotonic clock, dropping what it has no time for.

    Args:
        stamps: (K,) seconds, strictly increasing.
    """

    def __init__(self, stamps: Iterable[float]) -> None:
        self._stamps = [float(stamp) for stamp in stamps]
        self._lead: float | None = None  # what to add to the clock's time to get a stamp

    @property
    def playing(self) -> bool:
        """Whether time goes on."""
        return self._lead is not None

    def play(self, frame: int, now: float) -> None:
        """Let time go on from `frame`, which is due at `now` (seconds of any steady clock)."""
        self._lead = self._stamps[frame] - now

    def pause(self) -> None:
        """Let time stand still."""
        self._lead = None

    def frame(self, now: float) -> int:
        """The frame that is due at `now`; only while playing."""
        assert self._lead is not None
        # A float's rounding must not make the frame late that `wait` waited for.
        due = bisect.bisect_right(self._stamps, now + self._lead + 1e-6) - 1
        return max(due, 0)

    def wait(self, shown: int, now: float) -> float | None:
        """Seconds from `now` until a frame after `shown` is due, None where none will be."""
        if self._lead is None or shown + 1 >= len(self._stamps):
            return None
        return max(self._stamps[shown + 1] - self._lead - now, 0.0)

    def at_end(self, now: float) -> bool:
        """Whether the last frame is due at `now`; only while playing."""
        return self.frame(now) == len(self._stamps) - 1
