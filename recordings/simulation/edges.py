"""Depth discontinuities within zones: the surfaces in front and behind."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

STEP = 0.6
"""Smallest depth discontinuity within a zone, metres."""
_LEAST = 1 / 8  # smallest share of a zone's rays on either side


@dataclass(frozen=True)
class ZoneHits:
    """Surface hit by each zone.

    Attributes:
        distance: (S, rows, columns) metres as the sensor measures, inf where nothing is hit.
        piece: (S, rows, columns) index of the mesh that is hit, -1 for none.
    """

    distance: NDArray[np.float64]
    piece: NDArray[np.int64]


@dataclass(frozen=True)
class Edges:
    """Depth discontinuities within zones.

    Attributes:
        step: (S, rows, columns) whether a zone has one.
        front: surface in front; defined only where there is a step.
        behind: surface behind, likewise.
    """

    step: NDArray[np.bool_]
    front: ZoneHits
    behind: ZoneHits


def edges(distance: NDArray[np.float64], piece: NDArray[np.int64]) -> Edges:
    """Find the largest step within each zone.

    Args:
        distance: (S, rows, columns, R) metres of the rays of a zone, inf where nothing is hit.
        piece: (S, rows, columns, R) index of the mesh that a ray hits.
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

    return Edges(step, ZoneHits(front, piece_at(last)), ZoneHits(behind, piece_at(last + 1)))
