"""Timeline of a recording: missing frames, empty frames, and motion."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.analysis.pairs import moves
from recordings import Recording

# In median intervals: a missing frame makes 2; jitter alone makes up to 1.7.
_GAP = 1.75
_MOST_AT_ONCE = 2000  # frames whose truth is read at once; it may take milliseconds each


@dataclass(frozen=True)
class Timeline:
    """Gaps, empty stretches and motion of a recording, as far as known.

    Attributes:
        count: number of frames.
        gaps: frames directly after missing ones.
        empty: (first, last) frames of the stretches without points.
        moving: (first, last) frames of the stretches in which something moves.
        unread: frames at the end of a long recording whose truth is not read yet.
    """

    count: int
    gaps: tuple[int, ...]
    empty: tuple[tuple[int, int], ...]
    moving: tuple[tuple[int, int], ...]
    unread: int = 0


def has_counting_pair(timeline: Timeline, n: int) -> bool:
    """Whether something moves at both frames of any pair (k-n, k)."""
    moving = covered(timeline.moving, timeline.count)
    return bool((moving[: max(timeline.count - n, 0)] & moving[n:]).any())


def is_long(recording: Recording) -> bool:
    """Whether its truth is not read as a whole while somebody waits."""
    return len(recording) > _MOST_AT_ONCE


class RecordedTimeline:
    """The part of a timeline that needs no estimate: gaps, unplaced frames, true motion.

    The true motion of a long recording is read in pieces, by one thread while others look.

    Attributes:
        count: number of frames.
        read: frames whose true motion is known, from the first.
    """

    def __init__(self, recording: Recording) -> None:
        self.count = len(recording)
        self._gaps = gaps(recording.stamps)
        self._unplaced = recording.unplaced
        self._moving = np.zeros(self.count, dtype=bool) if recording.has_truth else None
        self.read = 0 if recording.has_truth else self.count
        if not is_long(recording):
            self.add(moves(recording, k) for k in range(self.read, self.count))

    @property
    def complete(self) -> bool:
        """Whether the true motion of all frames is known, or will never be."""
        return self.read == self.count

    def add(self, moving: Iterable[bool]) -> None:
        """Add whether the object truly moves at the next frames."""
        if self._moving is not None:
            flags = np.fromiter(moving, dtype=bool)
            self._moving[self.read : self.read + len(flags)] = flags
            self.read += len(flags)  # last: what others see of it is filled

    def with_estimates(self, empty: NDArray[np.bool_], moving: NDArray[np.bool_]) -> Timeline:
        """The whole timeline, with flags (K,) from estimates, False where unknown.

        Args:
            empty: whether a frame has no points.
            moving: whether something moves; ignored where there is truth.
        """
        return Timeline(
            self.count,
            self._gaps,
            stretches(self._unplaced | empty),
            stretches(moving if self._moving is None else self._moving),
            unread=self.count - self.read,
        )


def gaps(stamps: NDArray[np.float64]) -> tuple[int, ...]:
    """Frames directly after an interval long enough to miss a frame.

    Args:
        stamps: (K,) seconds, strictly increasing.
    """
    intervals = np.diff(stamps)
    if len(intervals) == 0:
        return ()
    return tuple(int(k) + 1 for k in np.flatnonzero(intervals > _GAP * np.median(intervals)))


def stretches(flags: ArrayLike) -> tuple[tuple[int, int], ...]:
    """(first, last) of each run of True flags (K,)."""
    padded = np.concatenate([[False], np.asarray(flags, dtype=bool), [False]])
    ends = np.flatnonzero(padded[1:] != padded[:-1])
    return tuple(zip(ends[::2].tolist(), (ends[1::2] - 1).tolist(), strict=True))


def covered(stretches: Iterable[tuple[int, int]], count: int) -> NDArray[np.bool_]:
    """Flags (K,) of the frames in stretches, the reverse of `stretches`."""
    flags = np.zeros(count, dtype=bool)
    for first, last in stretches:
        flags[first : last + 1] = True
    return flags


def neighbour(moving: Sequence[tuple[int, int]], frame: int, direction: int) -> int | None:
    """First frame of the next stretch (direction 1) or the previous one (-1), None at the ends.

    Within a stretch, the previous one is the stretch's own first frame.
    """
    starts = [first for first, _ in moving]
    if direction > 0:
        return min((start for start in starts if start > frame), default=None)
    return max((start for start in starts if start < frame), default=None)
