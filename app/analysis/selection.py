"""The cluster that a person has picked, found again in every further estimate."""

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from app.analysis.pairs import Pair
from estimator import ClusterResult

_TOLERANCE = 0.012  # rad between the ray of a click and a point that it still means
_SAME = 0.05  # metres between points of two estimates that are taken for the same


class Selection:
    """Follows a picked cluster by its points, since its number says nothing elsewhere.

    Where a cluster is not found, its points are kept: it may be there in the next estimate.
    """

    def __init__(self) -> None:
        self._points: NDArray[np.float64] | None = None

    def pick(self, pair: Pair, index: int | None) -> None:
        """Pick the cluster with this index in the pair's flow; None, or no such one, picks none."""
        picked = cluster_of(pair, index)
        self._points = None if picked is None else points_of(pair, picked)

    def follow(self, pair: Pair | None) -> int | None:
        """The index of the picked cluster in a pair's flow, None where it is not there.

        It is the one that most of the picked cluster's points belong to, half of them at least.
        """
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
        """Pick none."""
        self._points = None


def cluster_of(pair: Pair, index: int | None) -> ClusterResult | None:
    """The cluster with this index, None where the pair's flow has none."""
    clusters = pair.flow.clusters if pair.flow else ()
    return next((cluster for cluster in clusters if cluster.index == index), None)


def points_of(pair: Pair, cluster: ClusterResult) -> NDArray[np.float64]:
    """The points (N, 3) of a cluster of a pair's flow, of source and target."""
    assert pair.source is not None
    return np.vstack([pair.source.points[cluster.source], pair.target.points[cluster.target]])


def cluster_at(
    pair: Pair, origin: NDArray[np.float64], direction: NDArray[np.float64]
) -> int | None:
    """The cluster that a ray from the camera means: that of the point which is nearest to it.

    Args:
        pair: whose clusters are asked for.
        origin: (3,) metres, in the fixed frame.
        direction: (3,), of any length.

    Returns:
        The cluster's index, None where the ray passes all clusters by.
    """
    found: list[tuple[float, int]] = []
    direction = direction / np.linalg.norm(direction)
    for cluster in pair.flow.clusters if pair.flow else ():
        way = points_of(pair, cluster) - origin
        depth = way @ direction
        aside = np.linalg.norm(way - depth[:, None] * direction, axis=1)
        found.append((float(np.arctan2(aside, depth).min()), cluster.index))
    angle, index = min(found, default=(np.inf, -1))
    return index if angle <= _TOLERANCE else None
