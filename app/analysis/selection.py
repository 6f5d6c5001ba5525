"""Picked cluster, matched from one estimate to the next."""

import numpy as np
from numpy.typing import NDArray

from app.analysis.pairs import Pair
from estimator import ClusterResult

_SAME = 0.05  # maximum distance between matching points of two estimates, metres


class Selection:
    """Follows a picked cluster by its points, since indices differ between estimates.

    Where no cluster matches, the points are kept for the next estimate.
    """

    def __init__(self) -> None:
        self._points: NDArray[np.float64] | None = None
        self._awaited: int | None = None

    def await_cluster(self, index: int | None) -> None:
        """Pick the cluster with this index in the next pair that has a flow."""
        self._awaited = index

    def pick(self, pair: Pair, index: int | None) -> None:
        """Pick the cluster with this index, or none if the pair's flow lacks it."""
        picked = cluster_of(pair, index)
        self._points = None if picked is None else points_of(pair, picked)

    def follow(self, pair: Pair | None) -> int | None:
        """Index of the picked cluster in a pair's flow, None without a match.

        The match is the cluster nearest to most of the picked points, half of them at least.
        """
        from scipy.spatial import KDTree

        if self._awaited is not None and pair is not None and pair.flow is not None:
            index, self._awaited = self._awaited, None
            self.pick(pair, index)
        if self._points is None or pair is None or pair.flow is None or not pair.flow.clusters:
            return None
        points = [points_of(pair, cluster) for cluster in pair.flow.clusters]
        owner = np.repeat(np.arange(len(points)), [len(part) for part in points])
        distance, nearest = map(np.asarray, KDTree(np.vstack(points)).query(self._points))
        votes = np.bincount(owner[nearest[distance <= _SAME]], minlength=len(points))
        best = int(votes.argmax())
        if 2 * votes[best] < len(self._points):
            return None
        self._points = points[best]
        return pair.flow.clusters[best].index

    def drop(self) -> None:
        """Clear the selection."""
        self._points = self._awaited = None


def cluster_of(pair: Pair, index: int | None) -> ClusterResult | None:
    """The cluster with this index in the pair's flow, None if there is none."""
    clusters = pair.flow.clusters if pair.flow else ()
    return next((cluster for cluster in clusters if cluster.index == index), None)


def points_of(pair: Pair, cluster: ClusterResult) -> NDArray[np.float64]:
    """Source and target points (N, 3) of a cluster of a pair's flow."""
    assert pair.source is not None
    return np.vstack([pair.source.points[cluster.source], pair.target.points[cluster.target]])
