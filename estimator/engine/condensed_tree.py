"""Hierarchy of a spanning tree, and its condensed tree, in scikit-learn's order of rows."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from estimator.engine.compiled import compiled


class CondensedTree(NamedTuple):
    """What falls out of each cluster, and at which density; rows from the root downwards.

    Points are 0 to N - 1, the root cluster is N, the others follow.

    Attributes:
        parent: (R,) cluster.
        child: (R,) point or cluster that leaves it.
        density: (R,) 1 / m at which it leaves, inf for a distance of zero.
        size: (R,) points of the child.
        clusters: number of clusters, the root included.
    """

    parent: NDArray[np.int32]
    child: NDArray[np.int32]
    density: NDArray[np.float64]
    size: NDArray[np.int32]
    clusters: int


class Hierarchy(NamedTuple):
    """Single linkage: merge i makes node N + i of two nodes.

    Attributes:
        children: (N - 1, 2) the two nodes.
        distance: (N - 1,) metres.
        size: (N - 1,) points.
    """

    children: NDArray[np.int32]
    distance: NDArray[np.float64]
    size: NDArray[np.int32]


@compiled
def hierarchy(
    ends: NDArray[np.int32], weight: NDArray[np.float64], order: NDArray[np.int64]
) -> Hierarchy:
    """Merge along the edges of a spanning tree.

    Args:
        ends: (N - 1, 2) points at the ends of each edge.
        weight: (N - 1,) metres.
        order: (N - 1,) numbers of the edges from the shortest to the longest.
    """
    merges = len(order)
    points = merges + 1
    children, size = np.empty((merges, 2), np.int32), np.empty(merges, np.int32)
    distance = np.empty(merges)
    above = np.arange(points + merges).astype(np.int32)
    for merge in range(merges):
        edge, total = order[merge], 0
        for side in range(2):
            node = ends[edge, side]
            while above[node] != node:
                above[node] = above[above[node]]
                node = above[node]
            above[node] = points + merge
            children[merge, side] = node
            total += 1 if node < points else size[node - points]
        size[merge], distance[merge] = total, weight[edge]
    return Hierarchy(children, distance, size)


@compiled
def condensed_tree(merged: Hierarchy, min_cluster_size: int) -> CondensedTree:
    """Drop the splits whose smaller side is below the smallest cluster."""
    merges = len(merged.size)
    points = merges + 1
    rows = points + 2 * (points // min_cluster_size) + 2
    parent, child = np.empty(rows, np.int32), np.empty(rows, np.int32)
    density, size = np.empty(rows), np.empty(rows, np.int32)
    queue, cluster = np.empty(points, np.int32), np.zeros(merges, np.int32)
    inner = np.empty(2 * points, np.int32)
    row, clusters, head, tail = 0, 1, 0, 1
    queue[0], cluster[merges - 1] = merges - 1, points
    while head < tail:  # breadth first
        node = queue[head]
        head += 1
        distance = merged.distance[node]
        level = 1.0 / distance if distance > 0.0 else np.inf
        left, right = merged.children[node, 0], merged.children[node, 1]
        left_size = 1 if left < points else merged.size[left - points]
        right_size = 1 if right < points else merged.size[right - points]
        split = min(left_size, right_size) >= min_cluster_size
        for side in range(2):
            part = left if side == 0 else right
            part_size = left_size if side == 0 else right_size
            if part_size >= min_cluster_size:
                number = cluster[node]
                if split:
                    number = points + clusters
                    clusters += 1
                    parent[row], child[row] = cluster[node], number
                    density[row], size[row] = level, part_size
                    row += 1
                if part >= points:
                    cluster[part - points] = number
                    queue[tail] = part - points
                    tail += 1
                continue
            first = row
            row = _put_points(merged, part, inner, child, row)
            parent[first:row], density[first:row], size[first:row] = cluster[node], level, 1
    return CondensedTree(parent[:row], child[:row], density[:row], size[:row], clusters)


@compiled
def _put_points(
    merged: Hierarchy,
    node: int,
    inner: NDArray[np.int32],
    out: NDArray[np.int32],
    at: int,
) -> int:
    """Append the points below a node, level by level; return the new end.

    Args:
        merged: the hierarchy.
        node: whose points are wanted.
        inner: room for all nodes.
        out: receives the points.
        at: where they begin.
    """
    points = len(merged.size) + 1
    inner[0], head, tail = node, 0, 1
    while head < tail:
        below = inner[head]
        head += 1
        if below < points:
            out[at] = below
            at += 1
        else:
            inner[tail] = merged.children[below - points, 0]
            inner[tail + 1] = merged.children[below - points, 1]
            tail += 2
    return at
