"""Zones that look across a step: what is in front, and what is behind."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

STEP = 0.6
"""Metres between what is in front and what is behind, from which a zone looks across a step."""
_LEAST = 1 / 8  # share of the zone that each of the two fills at least


@dataclass(frozen=True)
class Seen:
    """What each zone sees.

    Attributes:
        distance: (S, rows, columns) metres as the sensor measures, inf where nothing is met.
        piece: (S, rows, columns) index of the piece that is met, -1 likewise.
    """

    distance: NDArray[np.float64]
    piece: NDArray[np.int64]


@dataclass(frozen=True)
class Edges:
    """Where zones look across a step.

    Attributes:
        step: (S, rows, columns) whether a zone does.
        front: what is in front; only meant where there is a step.
        behind: what is behind, likewise.
    """

    step: NDArray[np.bool_]
    front: Seen
    behind: Seen


def edges(distance: NDArray[np.float64], piece: NDArray[np.int64]) -> Edges:
    """Find the largest step within each zone.

    Args:
        distance: (S, rows, columns, R) metres along the rays of a zone, inf where nothing is met.
        piece: (S, rows, columns, R) index of the piece that a ray meets.
    """
    order = np.argsort(distance, axis=-1)
    sorted_distance = np.take_along_axis(distance, order, axis=-1)
    sorted_piece = np.take_along_axis(piece, order, axis=-1)
    rays = distance.shape[-1]
    least = max(round(_LEAST * rays), 1)
    known = np.where(np.isfinite(sorted_distance), sorted_distance, 0.0)
    gaps = np.diff(known, axis=-1)[..., least - 1 : rays - least]
    last = np.argmax(gaps, axis=-1) + least - 1
    step = (gaps.max(axis=-1) > STEP) & np.isfinite(distance).all(axis=-1)
    in_front = np.arange(rays) <= last[..., None]
    count = last + 1
    front = np.where(in_front, known, 0.0).sum(axis=-1) / count
    behind = np.where(in_front, 0.0, known).sum(axis=-1) / (rays - count)

    def piece_at(index: NDArray[np.int64]) -> NDArray[np.int64]:
        return np.take_along_axis(sorted_piece, index[..., None], axis=-1)[..., 0]

    return Edges(step, Seen(front, piece_at(last)), Seen(behind, piece_at(last + 1)))
