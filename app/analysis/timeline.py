"""Timeline of a recording: missing frames, empty frames, and motion."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.analysis.pairs import moves
from recordings import Recording

# In median intervals: a missing frame makes 2; jitter alone makes up to 1.7.
_GAP = 1.75


@dataclass(frozen=True)
class Timeline:
    """Gaps, empty stretches and motion of a recording, as far as known.

    Attributes:
        count: number of frames.
        gaps: frames directly after missing ones.
        empty: (first, last) frames of the stretches without points.
        moving: (first, last) frames of the stretches in which something moves.
    """

    count: int
    gaps: tuple[int, ...]
    empty: tuple[tuple[int, int], ...]
    moving: tuple[tuple[int, int], ...]


def has_counting_pair(timeline: Timeline, n: int) -> bool:
    """Whether something moves at both frames of any pair (k-n, k)."""
    moving = np.zeros(timeline.count, dtype=bool)
    for first, last in timeline.moving:
        moving[first : last + 1] = True
    return bool((moving[: max(timeline.count - n, 0)] & moving[n:]).any())


class RecordedTimeline:
    """The part of a timeline that needs no estimate: gaps, unplaced frames, true motion.

    Attributes:
        count: number of frames.
    """

    def __init__(self, recording: Recording) -> None:
        self.count = len(recording)
        self._gaps = gaps(recording.stamps)
        self._unplaced = recording.unplaced.tolist()
        self._moving = (
            [moves(recording, k) for k in range(self.count)] if recording.has_truth else None
        )

    def with_estimates(self, empty: Sequence[bool], moving: Sequence[bool]) -> Timeline:
        """The whole timeline, with flags (K,) from estimates, False where unknown.

        Args:
            empty: whether a frame has no points.
            moving: whether something moves; ignored where there is truth.
        """
        return Timeline(
            self.count,
            self._gaps,
            stretches(a or b for a, b in zip(self._unplaced, empty, strict=True)),
            stretches(moving if self._moving is None else self._moving),
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


def stretches(flags: Iterable[bool]) -> tuple[tuple[int, int], ...]:
    """(first, last) of each run of True flags."""
    return tuple(_runs(flags))


def _runs(flags: Iterable[bool]) -> Iterator[tuple[int, int]]:
    first = None
    k = -1
    for k, flag in enumerate(flags):
        if flag and first is None:
            first = k
        elif not flag and first is not None:
            yield first, k - 1
            first = None
    if first is not None:
        yield first, k


def neighbour(moving: Sequence[tuple[int, int]], frame: int, direction: int) -> int | None:
    """First frame of the next stretch (direction 1) or the previous one (-1), None at the ends.

    Within a stretch, the previous one is the stretch's own first frame.
    """
    starts = [first for first, _ in moving]
    if direction > 0:
        return min((start for start in starts if start > frame), default=None)
    return max((start for start in starts if start < frame), default=None)
