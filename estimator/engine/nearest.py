"""Nearest points, from a grid over the two axes along which the points reach furthest."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from estimator.engine.compiled import compiled

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

_POINTS_IN_CELL = 2.0
"""Mean of the cells, if the points filled the grid."""

_LEAST_WIDTH = 1e-100
"""Metres below which all points share a cell: the width's inverse has to be finite."""

NONE = -1


class Grid(NamedTuple):
    """Points sorted into cells.

    Attributes:
        points: (M, 3) metres, by cell.
        row: (M,) the row that each had before.
        first: (cells + 1,) first point of each cell; cells are ordered along v, then along u.
        u: the axis along which the points reach furthest or second furthest.
        v: the other one of these.
        low_u: lowest coordinate along u.
        low_v: lowest coordinate along v.
        width: of a cell, metres.
        per_metre: its inverse.
        cells_u: number of cells along u.
        cells_v: number of cells along v.
    """

    points: Floats
    row: Integers
    first: Integers
    u: int
    v: int
    low_u: float
    low_v: float
    width: float
    per_metre: float
    cells_u: int
    cells_v: int


@compiled
def make_grid(points: Floats) -> Grid:
    """Sort points (M, 3) in metres, M > 0, all finite, into a grid."""
    size = len(points)
    low, extent = np.empty(3), np.empty(3)
    for axis in range(3):
        lowest = highest = points[0, axis]
        for i in range(1, size):
            lowest = min(lowest, points[i, axis])
            highest = max(highest, points[i, axis])
        low[axis] = lowest
        extent[axis] = highest - lowest
    thin = np.argmin(extent)
    u = 1 if thin == 0 else 0
    v = 1 if thin == 2 else 2
    wide, narrow = max(extent[u], extent[v]), min(extent[u], extent[v])
    share = _POINTS_IN_CELL / size
    width = max(np.sqrt(wide * share * narrow), wide * share)
    if width < _LEAST_WIDTH:
        width = 1.0
    per_metre = 1.0 / width
    cells_u, cells_v = int(extent[u] * per_metre) + 1, int(extent[v] * per_metre) + 1

    cell = np.empty(size, np.int64)
    first = np.zeros(cells_u * cells_v + 2, np.int64)
    for i in range(size):
        in_u = int((points[i, u] - low[u]) * per_metre)
        in_v = int((points[i, v] - low[v]) * per_metre)
        cell[i] = in_v * cells_u + in_u
        first[cell[i] + 2] += 1
    for c in range(2, len(first)):
        first[c] += first[c - 1]
    # first[c + 1] is where the next point of cell c goes; in the end it is where c + 1 begins.
    ordered, row = np.empty((size, 3)), np.empty(size, np.int64)
    for i in range(size):
        k = first[cell[i] + 1]
        first[cell[i] + 1] += 1
        row[k] = i
        for axis in range(3):
            ordered[k, axis] = points[i, axis]
    return Grid(ordered, row, first, u, v, low[u], low[v], width, per_metre, cells_u, cells_v)


@compiled
def nearest_two(
    grid: Grid, x: float, y: float, z: float, radius: float, limit: float
) -> tuple[int, float, float]:
    """Find the nearest point to (x, y, z), and bound the distance of the second nearest.

    Args:
        grid: the points.
        x: metres.
        y: metres.
        z: metres.
        radius: how far to look at first, metres. It grows until it holds a point.
        limit: how far to look at most, metres.

    Returns:
        The place of the nearest in the grid, -1 where there is none within the limit; its
        distance, infinite for none; and a lower bound of the distances of all others.
    """
    points, first = grid.points, grid.first
    at_u = (x if grid.u == 0 else y) - grid.low_u
    at_v = (y if grid.v == 1 else z) - grid.low_v
    cells_u, end_u, end_v = grid.cells_u, float(grid.cells_u), float(grid.cells_v)
    while True:
        nearest, best, second = NONE, np.inf, np.inf  # squared
        from_u = int(min(max((at_u - radius) * grid.per_metre, 0.0), end_u))
        from_v = int(min(max((at_v - radius) * grid.per_metre, 0.0), end_v))
        to_u = int(min(max((at_u + radius) * grid.per_metre + 1.0, 0.0), end_u))
        to_v = int(min(max((at_v + radius) * grid.per_metre + 1.0, 0.0), end_v))
        for line in range(from_v, to_v):
            for k in range(first[line * cells_u + from_u], first[line * cells_u + to_u]):
                dx, dy, dz = points[k, 0] - x, points[k, 1] - y, points[k, 2] - z
                square = (dx * dx + dy * dy) + dz * dz
                # Choices instead of branches: which point is nearer cannot be foreseen.
                worse = square if square > best else best
                second = worse if worse < second else second
                nearest = k if square < best else nearest
                best = square if square < best else best
        distance = np.sqrt(best)
        if distance <= radius:
            return nearest, distance, min(np.sqrt(second), radius)
        if radius >= limit:
            return NONE, np.inf, limit
        radius = min(1.25 * distance if nearest != NONE else 2.0 * radius, limit)
