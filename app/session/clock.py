"""Playback of a recording in its own time, or faster, or slower."""

import bisect
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

SPEEDS = (0.1, 0.25, 0.5, 1.0, 2.0, 5.0)
"""Speeds that are offered, as multiples of the recording's own."""


@dataclass(frozen=True)
class Playback:
    """Range, speed and loop of playback.

    Attributes:
        first: frame of the range that is played.
        last: frame of the range that is played, included.
        speed: multiple of the recording's own speed.
        loop: whether the range is played again and again.
    """

    first: int
    last: int
    speed: float = 1.0
    loop: bool = False


class PlaybackClock:
    """Plays a recording's stamps against a steady clock, dropping what it has no time for.

    Args:
        stamps: (K,) seconds, strictly increasing.
        like: playback whose speed and loop are taken over.
    """

    def __init__(self, stamps: Iterable[float], like: Playback | None = None) -> None:
        self._stamps = [float(stamp) for stamp in stamps]
        whole = Playback(0, len(self._stamps) - 1)
        self.playback = replace(like, first=whole.first, last=whole.last) if like else whole
        # Seconds for which the last frame stays before a loop begins again.
        self._period = float(np.median(np.diff(self._stamps))) if whole.last > 0 else 0.1
        self._start: tuple[float, float] | None = None  # a stamp, and the time when it was due
        self._end = whole.last

    @property
    def playing(self) -> bool:
        """Whether time goes on."""
        return self._start is not None

    def play(self, frame: int, now: float) -> None:
        """Let time go on from `frame`, which is due at `now` (seconds of any steady clock)."""
        self._start = (self._stamps[frame], now)
        # A person who goes past the range wants to see what is there.
        beyond = frame > self.playback.last
        self._end = len(self._stamps) - 1 if beyond else self.playback.last

    def pause(self) -> None:
        """Let time stand still."""
        self._start = None

    def change(self, values: dict[str, Any], frame: int, now: float) -> None:
        """Play otherwise, {field of `Playback`: value}, while `frame` is shown.

        A range is kept within the recording.
        """
        start = (self._stamp(now), now) if self.playing else None
        playback = replace(self.playback, **values)
        last = min(max(playback.last, 0), len(self._stamps) - 1)
        first = min(max(playback.first, 0), last)
        self.playback = replace(playback, first=first, last=last)
        if start:
            self.play(frame, now)
            self._start = start  # a slider's many changes must not hold time up

    def advance(self, now: float) -> int:
        """The frame that is due at `now`, from which time goes on or not; only while playing."""
        # A float's rounding must not make the frame late that `wait` waited for.
        stamp = self._stamp(now) + 1e-6
        loop = self.playback.loop
        if stamp < self._stamps[self._end] + (self._period if loop else 0.0):
            return min(max(bisect.bisect_right(self._stamps, stamp) - 1, 0), self._end)
        if not loop:
            self.pause()
            return self._end
        self.play(self.playback.first, now)
        return self.playback.first

    def wait(self, frame: int, now: float) -> float | None:
        """Seconds from `now` until a frame after `frame` is due, None where none will be."""
        if not self.playing or (frame >= self._end and not self.playback.loop):
            return None
        due = self._stamps[self._end] + self._period
        if frame < self._end:
            due = self._stamps[frame + 1]
        return max((due - self._stamp(now)) / self.playback.speed, 0.0)

    def _stamp(self, now: float) -> float:
        assert self._start is not None
        stamp, then = self._start
        return stamp + (now - then) * self.playback.speed
