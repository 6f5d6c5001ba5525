"""Clusters of the merged cloud, with scikit-learn as judge."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sklearn.cluster import HDBSCAN

from estimator import Parameters, Window, window_of_pair
from estimator.clustering import clusters_of
from tests.estimator.engines import EXACT, using
from tests.estimator.scenes import cluttered, moved_patches


def labels_of(window: Window, parameters: Parameters) -> tuple[np.ndarray, np.ndarray]:
    """A label per target and per source point, -1 for noise."""
    target, source = np.full(len(window.target.points), -1), np.full(len(window.source.points), -1)
    for cluster in clusters_of(window, parameters):
        assert (target[cluster.target] == -1).all()
        assert (source[cluster.source] == -1).all()
        target[cluster.target] = cluster.index
        source[cluster.source] = cluster.index
    return target, source


@pytest.mark.parametrize(
    "settings",
    [
        {},
        {"min_cluster_size": 5},
        {"min_cluster_size": 40, "min_samples": 3},
        {"min_samples": 1},
        {"allow_single_cluster": True},
    ],
)
@pytest.mark.parametrize("engine", EXACT, ids=lambda engine: engine.name)
@pytest.mark.parametrize("seed", range(5))
def test_scikit_learn_finds_the_same_with_the_target_first(seed, engine, settings):
    scene, parameters = cluttered(seed), Parameters(**settings)
    with using(engine):
        target, source = labels_of(window_of_pair(scene.source, scene.target, 1.0), parameters)
    expected = HDBSCAN(
        min_cluster_size=parameters.min_cluster_size,
        min_samples=parameters.min_samples,
        allow_single_cluster=parameters.allow_single_cluster,
        copy=True,  # type: ignore[arg-type]
    ).fit_predict(np.vstack([scene.target, scene.source]))
    assert np.concatenate([target, source]).tolist() == expected.tolist()


def test_patches_far_apart_are_clusters_of_their_own():
    scene = moved_patches(np.random.default_rng(0), np.zeros((4, 3)))
    clusters = clusters_of(window_of_pair(scene.source, scene.target, 1.0), Parameters())
    assert [cluster.index for cluster in clusters] == [0, 1, 2, 3]
    found = {tuple(cluster.source) for cluster in clusters}
    assert found == {tuple(np.flatnonzero(scene.patch == p)) for p in range(4)}
    assert all((cluster.source == cluster.target).all() for cluster in clusters)


def test_one_object_alone_needs_allow_single_cluster():
    scene = moved_patches(np.random.default_rng(0), np.zeros((1, 3)), size=60)
    window = window_of_pair(scene.source, scene.target, 1.0)
    assert clusters_of(window, Parameters()) == ()
    (alone,) = clusters_of(window, Parameters(allow_single_cluster=True))
    assert len(alone.source) == len(alone.target) > 0


@given(seed=st.integers(0, 999), share=st.floats(0, 1), value=st.sampled_from([np.nan, np.inf]))
def test_points_that_are_not_finite_change_nothing_for_the_others(seed, share, value):
    scene, rng = cluttered(seed), np.random.default_rng(seed)
    gone = rng.uniform(size=len(scene.source)) < share
    holed = scene.source.copy()
    holed[gone, rng.integers(0, 3)] = value

    target, source = labels_of(window_of_pair(holed, scene.target, 1.0), Parameters())
    target_without, source_without = labels_of(
        window_of_pair(scene.source[~gone], scene.target, 1.0), Parameters()
    )
    assert (source[gone] == -1).all()
    assert source[~gone].tolist() == source_without.tolist()
    assert target.tolist() == target_without.tolist()


@pytest.mark.parametrize(
    ("sizes", "settings"),
    [
        ((0, 0), {}),
        ((1, 0), {"min_cluster_size": 2}),
        ((10, 9), {"min_cluster_size": 20}),
        ((20, 20), {"min_samples": 41}),
    ],
)
def test_fewer_points_than_hdbscan_needs_give_no_cluster(sizes, settings):
    rng = np.random.default_rng(0)
    source, target = (rng.normal(size=(size, 3)) for size in sizes)
    assert clusters_of(window_of_pair(source, target, 1.0), Parameters(**settings)) == ()


@pytest.mark.parametrize("settings", [{"min_cluster_size": 20}, {"min_samples": 40}])
def test_just_as_many_points_as_hdbscan_needs(settings):
    rng = np.random.default_rng(0)
    source, target = rng.normal(size=(2, settings.get("min_samples", 20) // 2, 3))
    parameters = Parameters(allow_single_cluster=True, **settings)
    assert len(clusters_of(window_of_pair(source, target, 1.0), parameters)) == 1


def test_the_clouds_are_left_as_they_were():
    scene = cluttered(0)
    source, target = scene.source.copy(), scene.target.copy()
    clusters_of(window_of_pair(source, target, 1.0), Parameters())
    assert (source == scene.source).all()
    assert (target == scene.target).all()
