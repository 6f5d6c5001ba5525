"""Scene flow assembled from the results of its clusters."""

import numpy as np
import pytest

from estimator import Label
from estimator.flow import Cluster, cluster_result, scene_flow


def test_a_scene_without_clusters_is_unassigned():
    flow = scene_flow(4, [])
    assert flow.label.tolist() == [Label.UNASSIGNED] * 4
    assert flow.cluster.tolist() == [-1] * 4
    assert flow.velocity.shape == (4, 3)
    assert np.isnan(flow.velocity).all()
    assert not flow.moving.any()
    assert flow.clusters == ()


def test_labels_are_numbered_as_agreed():
    assert (Label.UNASSIGNED, Label.STATIONARY, Label.MOVING) == (0, 1, 2)


def test_remaining_points_get_the_label_and_removed_ones_are_stationary():
    first = Cluster(0, source=np.array([0, 2, 4]), target=np.array([0]))
    second = Cluster(1, source=np.array([5, 6]), target=np.array([1]))
    velocity = np.array([(1.0, 2.0, 3.0)])
    flow = scene_flow(
        8,
        [
            cluster_result(first, np.array([4]), [], Label.MOVING, "it moves", velocity),
            cluster_result(second, np.array([6]), [], Label.UNASSIGNED, "too few"),
        ],
    )
    assert flow.cluster.tolist() == [0, -1, 0, -1, 0, 1, 1, -1]
    assert flow.label.tolist() == [1, 0, 1, 0, 2, 1, 0, 0]
    assert flow.velocity[4].tolist() == [1.0, 2.0, 3.0]
    assert np.isnan(np.delete(flow.velocity, 4, axis=0)).all()
    assert np.flatnonzero(flow.moving).tolist() == [4]


def test_a_cluster_without_a_round_has_no_fitness():
    cluster = Cluster(3, source=np.array([1]), target=np.array([2]))
    result = cluster_result(cluster, cluster.source, [], Label.UNASSIGNED, "too few")
    assert np.isnan(result.fitness)
    assert np.isnan(result.mean_displacement)
    assert result.removed.tolist() == []
    assert result.velocity == pytest.approx(np.full((1, 3), np.nan), nan_ok=True)
    assert result.reason == "Unassigned: too few."
