"""Prim's algorithm over mutual reachability, with scikit-learn's choice among equal edges.

scikit-learn begins at the first point and adds the nearest one each time: of several at the same
distance the first in the cloud's order, by the edge that first reached that distance. Which of
several equal edges is taken decides labels, so both functions here do exactly that.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from estimator.engine.compiled import compiled
from estimator.engine.lanes import first_equal_of_64, minimum_of_64


class Tree(NamedTuple):
    """Spanning tree in the order in which its points were added.

    Attributes:
        source: (N,) point from which each was reached; the first point is its own.
        point: (N,) the points, each once.
        weight: (N,) metres, length of the edge from `source` to `point`; inf where the point was
            reached by none, as is the first.
    """

    source: NDArray[np.int32]
    point: NDArray[np.int32]
    weight: NDArray[np.float64]


class Edges(NamedTuple):
    """Edges of a sparse graph, each in the rows of both its ends.

    Attributes:
        begin: (N + 1,) where each point's row begins in `point`; it ends where the next begins.
        point: the other end of each edge.
        weight: metres; empty for edges as long as the larger of their ends' core distances.
    """

    begin: NDArray[np.int64]
    point: NDArray[np.int32]
    weight: NDArray[np.float64]


@compiled
def sparse_prim(core: NDArray[np.float64], short: Edges, longer: Edges) -> Tree:
    """Span a graph; a component that no edge leads to begins at its first point.

    Args:
        core: (N,) metres, core distances.
        short: edges as long as the larger of their ends' core distances.
        longer: edges that are longer than that.
    """
    size = len(core)
    padded = (size + 63) // 64 * 64
    # `key` of a point in the tree is below every weight, its `waiting` above.
    key, waiting = np.full(padded, np.inf), np.full(padded, np.inf)
    nearest = np.full((padded // 64 + 63) // 64 * 64, np.inf)
    source = np.zeros(size, np.int32)
    tree = _empty(size)
    added = np.zeros(size, np.bool_)
    unreached = 0
    for step in range(size):
        weight, at = _first_minimum(nearest)
        if weight == np.inf:
            while added[unreached]:
                unreached += 1
            point = unreached
            source[point] = point
        else:
            point = at * 64 + first_equal_of_64(waiting, at * 64, weight)
        added[point] = True
        tree.source[step], tree.point[step], tree.weight[step] = source[point], point, weight
        key[point], waiting[point] = -1.0, np.inf
        nearest[point // 64] = minimum_of_64(waiting, point // 64 * 64)
        own = core[point]
        for edge in range(short.begin[point], short.begin[point + 1]):
            other = np.int64(short.point[edge])
            length = max(own, core[other])
            if length < key[other]:
                key[other] = waiting[other] = length
                source[other] = point
                nearest[other >> 6] = min(nearest[other >> 6], length)
        for edge in range(longer.begin[point], longer.begin[point + 1]):
            other, length = np.int64(longer.point[edge]), longer.weight[edge]
            if length < key[other]:
                key[other] = waiting[other] = length
                source[other] = point
                nearest[other >> 6] = min(nearest[other >> 6], length)
    return tree


@compiled
def _first_minimum(nearest: NDArray[np.float64]) -> tuple[float, int]:
    """Smallest value, and the place of the first that equals it."""
    smallest, at = np.inf, 0
    for begin in range(0, len(nearest), 64):
        value = minimum_of_64(nearest, begin)
        if value < smallest:
            smallest, at = value, begin
    return smallest, at + first_equal_of_64(nearest, at, smallest)


@compiled
def dense_prim(cloud: NDArray[np.float64], core: NDArray[np.float64]) -> Tree:
    """Span all pairs of points (3, N), in N² steps: for clouds whose graph is not sparse.

    Args:
        cloud: metres, one row an axis.
        core: (N,) metres, core distances.
    """
    size = len(core)
    x, y, z, cores = cloud[0].copy(), cloud[1].copy(), cloud[2].copy(), core.copy()
    number = np.arange(size).astype(np.int32)
    key, source = np.full(size, np.inf), np.zeros(size, np.int32)
    tree = _empty(size)
    at, weight = 0, np.inf
    for step in range(size):
        point = number[at]
        px, py, pz, own = x[at], y[at], z[at], cores[at]
        tree.source[step], tree.point[step], tree.weight[step] = source[at], point, weight
        left = size - step - 1
        # Those left stay in order, so that the first minimum is the first of the cloud.
        for i in range(at, left):
            x[i], y[i], z[i], cores[i] = x[i + 1], y[i + 1], z[i + 1], cores[i + 1]
            number[i], key[i], source[i] = number[i + 1], key[i + 1], source[i + 1]
        for i in range(left):
            dx, dy, dz = px - x[i], py - y[i], pz - z[i]
            distance = np.sqrt((dx * dx + dy * dy) + dz * dz)
            length = max(own, cores[i], distance)
            closer = length < key[i]
            key[i] = length if closer else key[i]
            source[i] = point if closer else source[i]
        weight, at = np.inf, 0
        for i in range(left):
            if key[i] < weight:
                weight, at = key[i], i
    return tree


@compiled
def _empty(size: int) -> Tree:
    return Tree(np.empty(size, np.int32), np.empty(size, np.int32), np.empty(size))
