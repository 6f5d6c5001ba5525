"""What a recording's timeline shows: where frames are missing, empty, or something moves."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.analysis.evaluation import moves
from recordings import Recording

# Median intervals: one frame that is missing makes 2 of them. Sensors that jitter come up to 1.7 of
# them late, with no frame missing.
_GAP = 1.75


@dataclass(frozen=True)
class Timeline:
    """A recording at a glance, as far as it is known.

    Attributes:
        count: number of frames.
        gaps: frames before which frames are missing.
        empty: (first, last) frames of the stretches in which no point is placed.
        moving: (first, last) frames of the stretches in which something moves.
    """

    count: int
    gaps: tuple[int, ...]
    empty: tuple[tuple[int, int], ...]
    moving: tuple[tuple[int, int], ...]


class RecordedTimeline:
    """What a recording says of its timeline by itself.

    Attributes:
        count: number of frames.
    """

    def __init__(self, recording: Recording) -> None:
        self.count = len(recording)
        self._gaps = gaps(recording.stamps)
        self._unplaced = _unplaced(recording)
        self._moving = (
            [moves(recording, k) for k in range(self.count)] if recording.has_truth else None
        )

    def with_estimates(self, empty: Sequence[bool], moving: Sequence[bool]) -> Timeline:
        """The timeline, with what estimates say: flags (K,), unset where nothing is known.

        Args:
            empty: whether no point is placed in a frame.
            moving: whether something moves; the truth goes before it where there is one.
        """
        return Timeline(
            self.count,
            self._gaps,
            stretches(a or b for a, b in zip(self._unplaced, empty, strict=True)),
            stretches(moving if self._moving is None else self._moving),
        )


def gaps(stamps: NDArray[np.float64]) -> tuple[int, ...]:
    """Frames before which the interval is so long that a frame is missing.

    Args:
        stamps: (K,) seconds, strictly increasing.
    """
    intervals = np.diff(stamps)
    if len(intervals) == 0:
        return ()
    return tuple(int(k) + 1 for k in np.flatnonzero(intervals > _GAP * np.median(intervals)))


def stretches(flags: Iterable[bool]) -> tuple[tuple[int, int], ...]:
    """(first, last) of each run of frames whose flag is set."""
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
    """Where the next stretch begins (direction 1) or the previous one (-1), None at the ends.

    Within a stretch the previous one is its own beginning.
    """
    starts = [first for first, _ in moving]
    if direction > 0:
        return min((start for start in starts if start > frame), default=None)
    return max((start for start in starts if start < frame), default=None)


def _unplaced(recording: Recording) -> list[bool]:
    """Whether each frame lies outside the known poses: those do at the start and at the end."""
    flags = [False] * len(recording)
    for frames in (range(len(flags)), reversed(range(len(flags)))):
        for k in frames:
            if np.isfinite(recording.T_fixed_sensor(k)).all(axis=(1, 2)).any():
                break
            flags[k] = True
    return flags
