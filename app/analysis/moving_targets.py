"""Where what moves has gone: points of the target that belong to moving source points."""

import numpy as np
from numpy.typing import NDArray

from app.analysis.pairs import Pair
from estimator import ClusterResult, Label

_NEAR = 0.06
"""Metres from where a source point went, within which a target point belongs to it."""


def moving_targets(pair: Pair) -> NDArray[np.bool_]:
    """Mask (M,) of a pair's target points that belong to what moves.

    Those of moving clusters without the inliers that were removed; where the method has no targets
    in its clusters, those near the place where a moving source point went.
    """
    from scipy.spatial import KDTree

    mask = np.zeros(len(pair.target.points), dtype=bool)
    if pair.source is None or pair.flow is None:
        return mask
    for cluster in pair.flow.clusters:
        if cluster.label == Label.MOVING:
            mask[_remaining(cluster)] = True
    moving = pair.flow.moving
    if not mask.any() and moving.any() and len(mask):
        arrived = pair.source.points[moving] + pair.interval * pair.flow.velocity[moving]
        distance = np.asarray(KDTree(arrived).query(pair.target.points)[0])
        mask = distance <= _NEAR
    return mask


def _remaining(cluster: ClusterResult) -> NDArray[np.int64]:
    """Indices of a moving cluster's target points without removed inliers."""
    removed = [each.inlier_target for each in cluster.rounds[:-1]]
    return np.setdiff1d(cluster.target, np.concatenate(removed)) if removed else cluster.target
