"""Core distances, and the neighbours within them."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from estimator.engine.blocks import BLOCK, Blocks, blocks_near
from estimator.engine.compiled import compiled
from estimator.engine.lanes import count_from, largest_below, near, put

_SELECTED = 32
"""Distances that the vector selection takes; where there are more, they are partitioned."""


class Neighbours(NamedTuple):
    """The points within each point's core distance.

    Attributes:
        squared_core: (P,) squared core distance of each point in the order of the blocks, inf
            beyond the last point.
        begin: (N + 1,) where each point's row begins in `other`; it ends where the next begins.
        other: places of the neighbours in the order of the blocks, without the point itself.
        squared: their squared distances.
        complete: whether all rows fitted; else rows are missing and core distances are right.
    """

    squared_core: NDArray[np.float64]
    begin: NDArray[np.int64]
    other: NDArray[np.int32]
    squared: NDArray[np.float64]
    complete: bool


@compiled
def neighbours(blocks: Blocks, k: int, room: int) -> Neighbours:
    """Find every point's core distance and all points within it.

    Args:
        blocks: of N points.
        k: the core distance is that of the k-th nearest point, the point itself being the first;
            at most N.
        room: most neighbours of all points together.
    """
    size = len(blocks.number)
    squared_core = np.full(blocks.points.shape[1], np.inf)
    begin = np.zeros(size + 1, np.int64)
    others, squares = np.empty(room, np.int32), np.empty(room)
    candidates = np.empty(blocks.boxes.shape[1] + BLOCK, np.int32)
    hits = np.empty(blocks.points.shape[1] + BLOCK, np.int32)
    squared = np.empty(blocks.points.shape[1] + _SELECTED)
    complete, filled = True, 0
    least = _least_radius(blocks)
    radius = guess = least  # squared, as all limits here
    for block in range((size + BLOCK - 1) // BLOCK):
        box = blocks.boxes[:, block]
        low, high = (box[0], box[1], box[2]), (box[3], box[4], box[5])
        listed = blocks_near(blocks, low, high, radius, candidates)
        widest = 0.0
        for i in range(block * BLOCK, min(block * BLOCK + BLOCK, size)):
            limit = min(guess, radius)
            found = _points_near(blocks, i, candidates[:listed], limit, hits)
            while found < k:
                if limit >= radius:
                    radius = max(2.0 * radius, least)
                    listed = blocks_near(blocks, low, high, radius, candidates)
                limit = min(max(1.5 * limit, least), radius)
                found = _points_near(blocks, i, candidates[:listed], limit, hits)
            _square_distances(blocks, i, hits[:found], squared)
            core = _smallest_but(squared, found, k)
            squared_core[i] = core
            guess, widest = 1.1 * core, max(widest, core)
            complete = complete and filled + found <= room
            if complete:
                for hit in range(found):
                    if squared[hit] <= core and hits[hit] != i:
                        others[filled], squares[filled] = hits[hit], squared[hit]
                        filled += 1
            begin[i + 1] = filled
        radius = max(1.5 * widest, least)
    return Neighbours(squared_core, begin, others[:filled], squares[:filled], complete)


@compiled
def _points_near(
    blocks: Blocks, i: int, candidates: NDArray[np.int32], limit: float, hits: NDArray[np.int32]
) -> int:
    """List the points of some blocks within a squared distance of point `i`; return how many."""
    x, y, z = blocks.points[0, i], blocks.points[1, i], blocks.points[2, i]
    found = 0
    for candidate in candidates:
        first = candidate * BLOCK
        found = put(hits, found, first, near(blocks.points, first, x, y, z, limit))
    return found


@compiled
def _square_distances(
    blocks: Blocks, i: int, others: NDArray[np.int32], out: NDArray[np.float64]
) -> None:
    points = blocks.points
    x, y, z = points[0, i], points[1, i], points[2, i]
    for at in range(len(others)):
        j = others[at]
        dx, dy, dz = points[0, j] - x, points[1, j] - y, points[2, j] - z
        out[at] = (dx * dx + dy * dy) + dz * dz


@compiled
def _least_radius(blocks: Blocks) -> float:
    """Squared radius that a search starts with and grows from, above zero unless all are equal."""
    total = 0.0
    for axis in range(3):
        side = blocks.superboxes[3 + axis].max() - blocks.superboxes[axis].min()
        total += side * side
    return total * 1e-7


@compiled
def _smallest_but(values: NDArray[np.float64], size: int, k: int) -> float:
    """The k-th smallest of `size` values, none below zero; 32 places beyond them are written."""
    if size > _SELECTED:
        return np.partition(values[:size], k - 1)[k - 1]
    values[size : size + _SELECTED] = -1.0
    bound = np.inf
    while True:
        bound = largest_below(values, 0, bound)
        if count_from(values, 0, bound) > size - k:
            return bound
