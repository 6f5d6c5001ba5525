"""Which messages belong to which frame."""

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
        duplicates: frames that were dropped because a later one has the same stamp.
    """

    stamps: NDArray[np.int64]
    message: NDArray[np.int64]
    period: float
    duplicates: int


def frame_table(stamps: list[NDArray[np.int64]]) -> FrameTable:
    """Put the messages of several sensors together into frames.

    Messages belong together whose stamps lie within half a period; the frame's stamp is the
    earliest of them. A sensor gives a frame one message: of several with the same stamp the last
    counts, and one with a later stamp opens a frame of its own.

    Args:
        stamps: header stamps (N_s,) in nanoseconds of each sensor, in the order of arrival.
    """
    kept = [_last_of_each(s) for s in stamps]
    period = _period([s[indices] for s, indices in zip(stamps, kept, strict=True)])
    stamp = np.concatenate([s[i] for s, i in zip(stamps, kept, strict=True)])
    sensor = np.concatenate([np.full(len(i), n) for n, i in enumerate(kept)])
    message = np.concatenate(kept)
    order = np.argsort(stamp, kind="stable")

    frame_stamps: list[int] = []
    rows: list[NDArray[np.int64]] = []
    for t, n, m in zip(
        stamp[order].tolist(), sensor[order].tolist(), message[order].tolist(), strict=True
    ):
        opens = not rows or t - frame_stamps[-1] > 0.5 * period or rows[-1][n] >= 0
        if opens:
            frame_stamps.append(t)
            rows.append(np.full(len(stamps), -1, dtype=np.int64))
        rows[-1][n] = m
    return FrameTable(
        stamps=np.array(frame_stamps, dtype=np.int64),
        message=np.array(rows, dtype=np.int64).reshape(-1, len(stamps)),
        period=period,
        duplicates=_duplicates(stamps),
    )


def _last_of_each(stamps: NDArray[np.int64]) -> NDArray[np.int64]:
    """Indices of the last message of each distinct stamp, in the order of the stamps."""
    _, first_from_behind = np.unique(stamps[::-1], return_index=True)
    return len(stamps) - 1 - first_from_behind


def _period(stamps: list[NDArray[np.int64]]) -> float:
    gaps = np.concatenate([np.diff(s) for s in stamps]) if stamps else np.zeros(0)
    return float(np.median(gaps)) if len(gaps) else 0.0


def _duplicates(stamps: list[NDArray[np.int64]]) -> int:
    """How many frames have a later one of the same stamp: the most that any sensor repeated it."""
    repeats: dict[int, int] = {}
    for s in stamps:
        distinct, counts = np.unique(s, return_counts=True)
        for t, count in zip(
            distinct[counts > 1].tolist(), counts[counts > 1].tolist(), strict=True
        ):
            repeats[t] = max(repeats.get(t, 0), count - 1)
    return sum(repeats.values())
