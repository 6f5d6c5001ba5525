"""Playback of a recording at its own speed or a multiple of it."""

import bisect
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from app.errors import InputError

SPEEDS = (0.1, 0.25, 0.5, 1.0, 2.0, 5.0)
"""Selectable speeds, as multiples of the recording's own."""

SHORT = 10.0
"""Seconds; shorter recordings are played again and again unless one chooses otherwise."""

_TOLERANCE = 1e-6  # seconds, so that rounding does not delay a frame that was waited for

LONGEST_WAIT = 5.0
"""Seconds; threads cannot wait for as long as stamps may be apart."""


@dataclass(frozen=True)
class Playback:
    """Range, speed and loop of playback.

    Attributes:
        first: first frame of the range.
        last: last frame of the range, inclusive.
        speed: multiple of the recording's own speed.
        loop: whether the range repeats.
    """

    first: int
    last: int
    speed: float = 1.0
    loop: bool = False


class PlaybackClock:
    """Plays a recording's stamps against a monotonic clock, dropping frames that are late.

    Args:
        stamps: (K,) seconds, strictly increasing.
        like: playback whose speed is kept.
    """

    def __init__(self, stamps: Iterable[float], like: Playback | None = None) -> None:
        self._stamps = [float(stamp) for stamp in stamps]
        whole = Playback(0, len(self._stamps) - 1, loop=self._stamps[-1] - self._stamps[0] < SHORT)
        self.playback = replace(whole, speed=like.speed) if like else whole
        # Seconds to show the last frame before a loop restarts.
        self._period = float(np.median(np.diff(self._stamps))) if whole.last > 0 else 0.1
        self._start: tuple[float, float] | None = (
            None  # a stamp, and the clock time at which it was due
        )
        self._end = whole.last

    @property
    def playing(self) -> bool:
        """Whether playback is running."""
        return self._start is not None

    def play(self, frame: int, now: float) -> None:
        """Start playback at `frame`, due at `now` (seconds of a monotonic clock)."""
        self._start = (self._stamps[frame], now)
        # Playback started beyond the range runs to the end of the recording.
        beyond = frame > self.playback.last
        self._end = len(self._stamps) - 1 if beyond else self.playback.last

    def pause(self) -> None:
        """Stop playback."""
        self._start = None

    def change(self, values: dict[str, Any], frame: int, now: float) -> None:
        """Change fields of `Playback`, {field: value}, while `frame` is shown.

        The range is clipped to the recording.

        Raises:
            InputError: the speed is none of `SPEEDS`.
        """
        if (speed := values.get("speed", 1.0)) not in SPEEDS:
            raise InputError(f"Speed must be one of {', '.join(map(str, SPEEDS))}, got {speed}.")
        start = (self._stamp(now), now) if self.playing else None
        playback = replace(self.playback, **values)
        last = min(max(playback.last, 0), len(self._stamps) - 1)
        first = min(max(playback.first, 0), last)
        self.playback = replace(playback, first=first, last=last)
        if start:
            self.play(frame, now)
            self._start = start  # keeps its pace during a slider's many changes

    def advance(self, now: float) -> int:
        """The frame due at `now`; stops at the end unless looping. Only while playing."""
        stamp = self._stamp(now) + _TOLERANCE
        loop = self.playback.loop
        if stamp < self._stamps[self._end] + (self._period if loop else 0.0):
            return self._frame_at(stamp)
        if not loop:
            self.pause()
            return self._end
        self.play(self.playback.first, now)
        return self.playback.first

    def coming(self, now: float, seconds: float, count: int) -> list[int]:
        """The next frames due after `now`, at least so many `seconds` apart; none unless playing.

        Args:
            now: seconds of a monotonic clock.
            seconds: that the drawing of a frame takes.
            count: of frames.
        """
        if not self.playing:
            return []
        step = max(seconds, self._period / self.playback.speed)
        due = [
            self._frame_at(self._stamp(now + i * step) + _TOLERANCE) for i in range(1, count + 1)
        ]
        return list(dict.fromkeys(due))

    def wait(self, frame: int, now: float) -> float | None:
        """Seconds from `now` until the frame after `frame` is due, None if none will be.

        At most `LONGEST_WAIT`, after which to ask again: a clock of a recording may jump by years.
        """
        if not self.playing or (frame >= self._end and not self.playback.loop):
            return None
        due = self._stamps[self._end] + self._period
        if frame < self._end:
            due = self._stamps[frame + 1]
        return min(max((due - self._stamp(now)) / self.playback.speed, 0.0), LONGEST_WAIT)

    def _frame_at(self, stamp: float) -> int:
        return min(max(bisect.bisect_right(self._stamps, stamp) - 1, 0), self._end)

    def _stamp(self, now: float) -> float:
        assert self._start is not None
        stamp, then = self._start
        return stamp + (now - then) * self.playback.speed
