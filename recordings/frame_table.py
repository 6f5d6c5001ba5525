"""Frames of a recording: assignment of the sensors' messages to frames."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


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
    """
    period = _period(stamps)
    stamp = np.concatenate(stamps)
    sensor = np.concatenate([np.full(len(s), n) for n, s in enumerate(stamps)])
    message = np.concatenate([np.arange(len(s)) for s in stamps])
    order = np.argsort(stamp, kind="stable")

    frame_stamps: list[int] = []
    rows: list[NDArray[np.int64]] = []
    dropped: list[NDArray[np.int64]] = []
    for t, n, m in zip(
        stamp[order].tolist(), sensor[order].tolist(), message[order].tolist(), strict=True
    ):
        if not rows or t - frame_stamps[-1] > 0.5 * period:
            frame_stamps.append(t)
            rows.append(np.full(len(stamps), -1, dtype=np.int64))
            dropped.append(np.zeros(len(stamps), dtype=np.int64))
        dropped[-1][n] += rows[-1][n] >= 0
        rows[-1][n] = m
    return FrameTable(
        stamps=np.array(frame_stamps, dtype=np.int64),
        message=np.array(rows, dtype=np.int64).reshape(-1, len(stamps)),
        period=period,
        duplicates=int(sum(d.max() for d in dropped)),
    )


def _period(stamps: list[NDArray[np.int64]]) -> float:
    """Median time between distinct stamps of a sensor, 0 where there are none."""
    gaps = np.concatenate([np.diff(np.unique(s)) for s in stamps])
    return float(np.median(gaps)) if len(gaps) else 0.0
