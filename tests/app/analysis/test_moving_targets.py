"""Target points of what moves."""

from dataclasses import replace

import numpy as np

from app.analysis.estimates import Estimates
from app.analysis.moving_targets import moving_targets
from estimator import Label, Parameters
from tests.app.fake_recordings import fake_opened


def test_they_are_those_of_moving_clusters():
    pair = Estimates().estimated(fake_opened(), 20, Parameters())
    assert pair.flow is not None
    (cluster,) = [c for c in pair.flow.clusters if c.label == Label.MOVING]
    np.testing.assert_array_equal(np.flatnonzero(moving_targets(pair)), np.sort(cluster.target))
    assert not moving_targets(replace(pair, flow=None)).any()


def test_removed_inliers_are_none_of_them():
    pair = Estimates().estimated(fake_opened(), 20, Parameters())
    assert pair.flow is not None
    clusters = list(pair.flow.clusters)
    at = next(i for i, c in enumerate(clusters) if c.label == Label.MOVING)
    removed = replace(clusters[at].rounds[0], inlier_target=clusters[at].target[:5])
    clusters[at] = replace(clusters[at], rounds=(removed, *clusters[at].rounds))
    found = moving_targets(replace(pair, flow=replace(pair.flow, clusters=tuple(clusters))))
    assert not found[clusters[at].target[:5]].any()
    assert found.sum() == len(clusters[at].target) - 5


def test_without_clusters_they_are_where_moving_points_went():
    pair = Estimates().estimated(fake_opened(), 20, Parameters())
    assert pair.flow is not None
    found = moving_targets(replace(pair, flow=replace(pair.flow, clusters=())))
    known = moving_targets(pair)
    assert (found & known).sum() > 0.9 * known.sum()
    assert (found & ~known).sum() < 0.1 * known.sum()
