"""Choice of clusters by excess of mass, labels and probabilities, as scikit-learn computes them."""

import numpy as np
from numpy.typing import NDArray

from estimator.engine.compiled import compiled
from estimator.engine.condensed_tree import CondensedTree


@compiled
def labels_of(
    tree: CondensedTree, points: int, allow_single_cluster: bool
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Label each point with its cluster.

    Args:
        tree: of the points.
        points: number of points, N.
        allow_single_cluster: whether the root may be a cluster.

    Returns:
        Labels (N,) from 0, -1 for noise, and probabilities (N,) of belonging to the cluster.
    """
    selected = _selected(tree, points, allow_single_cluster)
    number = np.cumsum(selected) - 1  # of each selected cluster
    holder, deaths = _holders(tree, points, selected), _deaths(tree, points)
    # The root as the only cluster holds the points that leave it last.
    least = _last_density(tree, points) if selected[0] else np.inf
    label, probability = np.full(points, -1), np.zeros(points)
    for row in range(len(tree.child)):
        point = tree.child[row]
        if point >= points:
            continue
        cluster, density = holder[tree.parent[row] - points], tree.density[row]
        if not selected[cluster] or (cluster == 0 and density < least):
            continue
        label[point] = number[cluster]
        death = deaths[cluster]
        whole = death == 0.0 or density == np.inf
        probability[point] = 1.0 if whole else min(density, death) / death
    return label, probability


@compiled
def _holders(tree: CondensedTree, points: int, selected: NDArray[np.bool_]) -> NDArray[np.int64]:
    """The selected cluster that each cluster is or is inside, the root where there is none."""
    holder = np.arange(tree.clusters)
    for row in range(len(tree.child)):  # from the root downwards
        cluster = tree.child[row] - points
        if cluster >= 0 and not selected[cluster]:
            holder[cluster] = holder[tree.parent[row] - points]
    return holder


@compiled
def _last_density(tree: CondensedTree, points: int) -> float:
    """Highest density at which anything leaves the root."""
    highest = 0.0
    for row in range(len(tree.child)):
        if tree.parent[row] == points:
            highest = max(highest, tree.density[row])
    return highest


@compiled
def _selected(tree: CondensedTree, points: int, allow_single_cluster: bool) -> NDArray[np.bool_]:
    """Whether each cluster is one of the most stable ones, of which none is inside another."""
    stability, above = _stabilities(tree, points)
    below = np.zeros(tree.clusters)  # stability of what is inside
    selected = np.ones(tree.clusters, np.bool_)
    lowest = 0 if allow_single_cluster else 1
    selected[:lowest] = False
    for cluster in range(tree.clusters - 1, lowest - 1, -1):  # from the leaves upwards
        if below[cluster] > stability[cluster]:
            selected[cluster] = False
            stability[cluster] = below[cluster]
        if cluster > 0:
            below[above[cluster]] += stability[cluster]
    inside = np.zeros(tree.clusters, np.bool_)
    for cluster in range(1, tree.clusters):
        inside[cluster] = inside[above[cluster]] or selected[above[cluster]]
    return selected & ~inside


@compiled
def _stabilities(tree: CondensedTree, points: int) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Stability of each cluster, and the cluster that it is inside of."""
    births, stability = np.zeros(tree.clusters), np.zeros(tree.clusters)
    above = np.zeros(tree.clusters, np.int64)
    for row in range(len(tree.child)):
        cluster = tree.child[row] - points
        if cluster >= 0:
            births[cluster], above[cluster] = tree.density[row], tree.parent[row] - points
    for row in range(len(tree.child)):
        cluster = tree.parent[row] - points
        stability[cluster] += (tree.density[row] - births[cluster]) * tree.size[row]
    return stability, above


@compiled
def _deaths(tree: CondensedTree, points: int) -> NDArray[np.float64]:
    """Highest density of each cluster in its last unbroken run of rows."""
    deaths = np.zeros(tree.clusters)
    for row in range(len(tree.child)):
        cluster = tree.parent[row] - points
        begins = row == 0 or tree.parent[row - 1] != tree.parent[row]
        deaths[cluster] = tree.density[row] if begins else max(deaths[cluster], tree.density[row])
    return deaths
