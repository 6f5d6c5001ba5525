"""Spanning trees in plain Python, and clouds that are hard to span."""

import numpy as np
from numpy.typing import NDArray

from estimator.engine.prim import Edges, Tree


def squared_distances(cloud: NDArray[np.float64]) -> NDArray[np.float64]:
    """Squared distances (N, N) of a cloud (N, 3)."""
    x, y, z = (cloud[:, None, axis] - cloud[None, :, axis] for axis in range(3))
    return (x * x + y * y) + z * z


def lengths(cloud: NDArray[np.float64], core: NDArray[np.float64]) -> NDArray[np.float64]:
    """Mutual reachability (N, N) in metres of a cloud (N, 3)."""
    return np.maximum(np.sqrt(squared_distances(cloud)), np.maximum(core[:, None], core))


def plain_prim(length: NDArray[np.float64]) -> tuple[list[int], list[int], list[float]]:
    """Sources, points and weights: of equal edges the first point, and how it was first reached."""
    size, at = len(length), 0
    key, source, left = [np.inf] * size, [0] * size, list(range(1, size))
    sources, points, weights = [0], [0], [np.inf]
    while left:
        for other in left:
            if length[at, other] < key[other]:
                key[other], source[other] = length[at, other], at
        at = min(left, key=lambda other: (key[other], other))
        left.remove(at)
        sources.append(source[at])
        points.append(at)
        weights.append(float(key[at]))
    return sources, points, weights


def as_lists(tree: Tree) -> tuple[list[int], list[int], list[float]]:
    """A tree to compare with another."""
    return tree.source.tolist(), tree.point.tolist(), tree.weight.tolist()


def no_edges(size: int) -> Edges:
    """A graph without edges, of weights of its own."""
    return Edges(np.zeros(size + 1, np.int64), np.empty(0, np.int32), np.empty(0))
