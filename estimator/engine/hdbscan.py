"""HDBSCAN with scikit-learn's labels and probabilities."""

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from estimator.engine.compiled import compiled
from estimator.engine.condensed_tree import condensed_tree, hierarchy
from estimator.engine.labels import labels_of
from estimator.engine.spanning_tree import spanning_tree


def hdbscan(
    points: NDArray[np.float64],
    min_cluster_size: int,
    min_samples: int | None = None,
    *,
    allow_single_cluster: bool = False,
    order: Literal["stable", "quicksort"] = "stable",
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Cluster points as `sklearn.cluster.HDBSCAN` does with the same parameters.

    Args:
        points: (N, 3) metres, finite and within 1e100.
        min_cluster_size: smallest cluster, at least 2.
        min_samples: neighbours of a core point, itself included, at most N; None means
            `min_cluster_size`.
        allow_single_cluster: whether everything may be one cluster.
        order: how edges of equal length are sorted. "stable" leaves them in the tree's order, so
            that every processor gives the same labels; "quicksort" is scikit-learn's own, which
            depends on the processor.

    Returns:
        Labels (N,) from 0, -1 for noise, and probabilities (N,).
    """
    # A copy is always of the one type that is compiled: writable, and row by row.
    cloud = np.array(points, np.float64, order="C")
    ends, weight = _edges(cloud, min_samples or min_cluster_size)
    in_order = np.argsort(weight, kind=order)
    return _labels(ends, weight, in_order, min_cluster_size, allow_single_cluster)


@compiled
def _edges(points: NDArray[np.float64], k: int) -> tuple[NDArray[np.int32], NDArray[np.float64]]:
    tree = spanning_tree(points, k)
    ends = np.empty((len(points) - 1, 2), np.int32)
    for edge in range(len(ends)):
        ends[edge, 0], ends[edge, 1] = tree.source[edge + 1], tree.point[edge + 1]
    return ends, tree.weight[1:].copy()


@compiled
def _labels(
    ends: NDArray[np.int32],
    weight: NDArray[np.float64],
    order: NDArray[np.int64],
    min_cluster_size: int,
    allow_single_cluster: bool,
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    tree = condensed_tree(hierarchy(ends, weight, order), min_cluster_size)
    return labels_of(tree, len(weight) + 1, allow_single_cluster)
