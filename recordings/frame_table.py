"""Frames of a recording: assignment of the sensors' messages to frames."""

import math
from bisect import bisect_right
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from recordings.errors import RecordingError

MOST_READINGS = 2**25
"""Frames of a recording times its sensors: 25 hours of 24 sensors at 15 Hz."""


@dataclass(frozen=True)
class FrameTable:
    """The frames of a recording.

    Attributes:
        stamps: (K,) nanoseconds, strictly increasing.
        message: (K, S) index of each sensor's message in its own table, -1 where it has none.
        period: median time between two readings of a sensor, nanoseconds, 0 where unknown.
        duplicates: readings dropped because the same sensor has a later one in the frame; per
            frame that of the sensor with the most.
    """

    stamps: NDArray[np.int64]
    message: NDArray[np.int64]
    period: float
    duplicates: int

    @property
    def completeness(self) -> float:
        """Mean share of the sensors that a frame has a message of."""
        return float((self.message >= 0).mean()) if self.message.size else 0.0


def frame_table(stamps: list[NDArray[np.int64]]) -> FrameTable:
    """Group the messages of several sensors into frames.

    A frame holds the messages within half a period after its stamp, the earliest of theirs; of
    several messages of a sensor it keeps the last.

    Args:
        stamps: header stamps (N_s,) in nanoseconds of each sensor, in the order of arrival.

    Raises:
        RecordingError: there are too many frames.
    """
    period = _period(stamps)
    span = math.floor(0.5 * period)
    if _one_frame_each(stamps, span):
        _check_size(len(stamps[0]), len(stamps))
        rows = np.arange(len(stamps[0]))[:, None]
        return FrameTable(stamps[0], np.repeat(rows, len(stamps), axis=1), period, 0)
    stamp = np.concatenate(stamps)
    sensor = np.concatenate([np.full(len(s), n) for n, s in enumerate(stamps)])
    message = np.concatenate([np.arange(len(s)) for s in stamps])
    order = np.argsort(stamp, kind="stable")

    stamp, sensor, message = stamp[order], sensor[order], message[order]

    first = _first_of_frames(stamp.tolist(), span)
    _check_size(len(first), len(stamps))
    frame = np.repeat(np.arange(len(first)), np.diff([*first, len(stamp)]))
    table = np.full((len(first), len(stamps)), -1, dtype=np.int64)
    table[frame, sensor] = message  # of several the last
    cells = np.sort(frame * len(stamps) + sensor)
    starts = np.flatnonzero(np.diff(cells, prepend=-1))
    dropped = np.zeros(len(first), dtype=np.int64)
    again = np.diff(starts, append=len(cells)) - 1
    np.maximum.at(dropped, cells[starts] // len(stamps), again)
    return FrameTable(
        stamps=stamp[first],
        message=table,
        period=period,
        duplicates=int(dropped.sum()),
    )


def _one_frame_each(stamps: list[NDArray[np.int64]], span: int) -> bool:
    """Whether all sensors have the same stamps, each further than `span` ns after the one before.

    So it is in a file of ours; then nothing has to be sorted.
    """
    first = stamps[0]
    same = all(np.array_equal(first, others) for others in stamps[1:])
    return same and len(first) > 0 and bool((np.diff(first) > span).all())


def _check_size(frames: int, sensors: int) -> None:
    if frames * sensors > MOST_READINGS:
        raise RecordingError(
            f"The stamps of {sensors} sensors make {frames} frames, and there may be "
            f"{MOST_READINGS} readings; give the file in parts."
        )


def _first_of_frames(stamps: list[int], span: int) -> list[int]:
    """Index of the first message of each frame, which holds those up to `span` ns later."""
    first: list[int] = []
    i = 0
    while i < len(stamps):
        first.append(i)
        i = bisect_right(stamps, stamps[i] + span, lo=i + 1)
    return first


def _period(stamps: list[NDArray[np.int64]]) -> float:
    """Median time between distinct stamps of a sensor, 0 where there are none."""
    if all(np.array_equal(stamps[0], others) for others in stamps[1:]):
        stamps = stamps[:1]
    gaps = np.concatenate([np.diff(np.sort(s)) for s in stamps])
    gaps = gaps[gaps > 0]
    return float(np.median(gaps)) if len(gaps) else 0.0
