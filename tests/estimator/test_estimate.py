"""The one call: defined results for every input, and what holds for every scene."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from estimator import (
    CloudError,
    Label,
    Parameters,
    SceneFlow,
    estimate_scene_flow,
)
from tests.estimator.scenes import (
    Scene,
    cluttered,
    corner,
    methods_of_points,
    moved_patches,
)

INTERVAL = 8 / 15
SEEDS = st.integers(0, 2**32 - 1)
methods = pytest.mark.parametrize("method", methods_of_points())


def flow_of(scene: Scene, interval: float = INTERVAL, **settings: object) -> SceneFlow:
    parameters = Parameters(**{"n_min": 20, **settings})  # type: ignore[arg-type]
    return estimate_scene_flow(scene.source, scene.target, interval, parameters)


def assert_nothing_found(flow: SceneFlow, size: int) -> None:
    assert flow.label.tolist() == [Label.UNASSIGNED] * size
    assert flow.velocity.shape == (size, 3)
    assert np.isnan(flow.velocity).all()


@methods
@pytest.mark.parametrize(("source_size", "target_size"), [(0, 0), (0, 300), (300, 0), (1, 1)])
def test_empty_and_tiny_clouds(source_size, target_size, method):
    cloud = np.vstack([corner(np.random.default_rng(i)) + 2.0 * i for i in range(3)])
    flow = estimate_scene_flow(
        cloud[:source_size], cloud[:target_size], INTERVAL, Parameters(method=method, n_min=1)
    )
    assert_nothing_found(flow, source_size)


@methods
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_clouds_of_nothing_finite(value, method):
    cloud = np.full((100, 3), value)
    flow = estimate_scene_flow(cloud, cloud, INTERVAL, Parameters(method=method))
    assert_nothing_found(flow, 100)
    assert flow.clusters == ()


@methods
def test_a_point_that_is_not_finite_is_unassigned_and_harms_no_other(method):
    scene = moved_patches(np.random.default_rng(0), np.array([(0.08, 0, 0), (0, 0, 0)]))
    holes = np.arange(0, 200, 7)
    source = np.insert(scene.source, holes, np.nan, axis=0)
    target = np.vstack([scene.target, [(np.nan, 0, 0), (0, np.inf, 0)]])
    kept = np.isfinite(source).all(axis=1)

    parameters = Parameters(method=method)
    flow = estimate_scene_flow(source, target, INTERVAL, parameters)
    without = estimate_scene_flow(scene.source, scene.target, INTERVAL, parameters)
    assert (flow.label[~kept] == Label.UNASSIGNED).all()
    assert (flow.cluster[~kept] == -1).all()
    assert flow.label[kept].tolist() == without.label.tolist()
    assert np.array_equal(flow.velocity[kept], without.velocity, equal_nan=True)


@methods
@pytest.mark.parametrize("sizes", [(300, 300), (300, 30), (30, 300), (3, 3), (10, 10)])
@pytest.mark.parametrize("alone", [False, True])
def test_all_points_equal(sizes, alone, method):
    source, target = (np.full((size, 3), 0.5) for size in sizes)
    flow = estimate_scene_flow(
        source, target, INTERVAL, Parameters(method=method, allow_single_cluster=alone)
    )
    assert len(flow.label) == sizes[0]
    velocity = flow.velocity[flow.moving]
    assert velocity == pytest.approx(np.zeros_like(velocity), abs=1e-9)
    if method == "paper":
        assert not flow.moving.any()


@methods
@pytest.mark.parametrize("sizes", [(19, 0), (10, 9), (30, 29), (1, 2), (2, 60)])
def test_fewer_points_than_the_thresholds(sizes, method):
    rng = np.random.default_rng(0)
    source, target = (rng.uniform(0, 0.2, (size, 3)) for size in sizes)
    flow = estimate_scene_flow(
        source, target, INTERVAL, Parameters(method=method, allow_single_cluster=True)
    )
    assert_nothing_found(flow, sizes[0])
    for cluster in flow.clusters:
        assert cluster.rounds == ()
        assert cluster.label == Label.UNASSIGNED
        assert cluster.reason.startswith("Unassigned: ")


def test_all_points_of_a_plane_and_of_a_line():
    rng = np.random.default_rng(0)
    for flat in ((1.0, 1.0, 0.0), (1.0, 0.0, 0.0)):
        patches = [rng.uniform(0, 0.3, (100, 3)) * flat + place for place in (0.0, 2.0, 4.0)]
        cloud = np.vstack(patches)
        flow = estimate_scene_flow(cloud, cloud, INTERVAL, Parameters())
        assert not flow.moving.any()
        assert np.isfinite([cluster.fitness for cluster in flow.clusters]).all()


def test_far_away_is_as_good_as_near():
    scene = moved_patches(np.random.default_rng(0), np.array([(0.08, 0, 0), (0, 0, 0)]))
    flow = estimate_scene_flow(scene.source + 1e4, scene.target + 1e4, INTERVAL, Parameters())
    assert flow.velocity[:100] == pytest.approx(np.tile([0.15, 0, 0], (100, 1)), abs=1e-3)


@pytest.mark.parametrize("cloud", [np.zeros(3), np.zeros((4, 2)), "cloud", None])
def test_what_is_no_cloud_is_one_clear_error(cloud):
    good = np.zeros((5, 3))
    for source, target in ((cloud, good), (good, cloud)):
        with pytest.raises(CloudError) as caught:
            estimate_scene_flow(source, target, INTERVAL, Parameters())
        assert str(caught.value).count("\n") == 0
        assert str(caught.value).endswith(".")


@methods
@given(seed=SEEDS)
def test_labels_partition_the_source(method, seed):
    scene = cluttered(seed)
    flow = flow_of(scene, method=method)
    size = len(scene.source)
    assert flow.label.shape == flow.cluster.shape == (size,)
    assert set(flow.label) <= {0, 1, 2}
    assert (np.isfinite(flow.velocity).all(axis=1) == flow.moving).all()
    assert (np.isnan(flow.velocity).all(axis=1) == ~flow.moving).all()
    assert (flow.label[flow.cluster == -1] == Label.UNASSIGNED).all()

    assert [cluster.index for cluster in flow.clusters] == list(range(len(flow.clusters)))
    for cluster in flow.clusters:
        assert cluster.source.tolist() == np.flatnonzero(flow.cluster == cluster.index).tolist()
        parts = np.concatenate([cluster.remaining, cluster.removed])
        assert sorted(parts) == cluster.source.tolist()
        assert (flow.label[cluster.remaining] == cluster.label).all()
        assert (flow.label[cluster.removed] == Label.STATIONARY).all()
        assert np.array_equal(flow.velocity[cluster.remaining], cluster.velocity, equal_nan=True)


@given(seed=SEEDS)
def test_the_story_of_a_cluster_adds_up(seed):
    scene = cluttered(seed)
    for cluster in flow_of(scene, n_min=5).clusters:
        source, target = cluster.source, cluster.target
        for number, current in enumerate(cluster.rounds):
            assert (current.source_size, current.target_size) == (len(source), len(target))
            assert current.fitness == len(current.inlier_source) / len(source)
            R, t = current.transformation[:3, :3], current.transformation[:3, 3]
            assert np.allclose(R @ R.T, np.eye(3), atol=1e-9)
            points = scene.source[source]
            moved = points @ R.T + t
            lengths = np.linalg.norm(moved - points, axis=1)
            assert current.mean_displacement == pytest.approx(lengths.mean())
            gaps = np.linalg.norm(
                scene.source[current.inlier_source] @ R.T + t - scene.target[current.inlier_target],
                axis=1,
            )
            assert (gaps <= 0.1 + 1e-9).all()
            last = number == len(cluster.rounds) - 1
            assert (current.fitness > 0.7) == (last and cluster.label != Label.UNASSIGNED)
            if not last or cluster.label == Label.UNASSIGNED:
                source = np.setdiff1d(source, current.inlier_source)
                target = np.setdiff1d(target, current.inlier_target)
        assert cluster.remaining.tolist() == source.tolist()


@methods
@given(seed=SEEDS, shift=st.tuples(*[st.integers(-(2**21), 2**21)] * 3))
def test_moving_the_whole_scene_changes_nothing(method, seed, shift):
    scene = cluttered(seed)
    # Steps of the scene's own grid, so that no distance between points is rounded anew.
    step = np.array(shift) / 2.0**20
    elsewhere = Scene(scene.source + step, scene.target + step, scene.patch)
    here, there = flow_of(scene, method=method), flow_of(elsewhere, method=method)
    assert here.label.tolist() == there.label.tolist()
    assert here.cluster.tolist() == there.cluster.tolist()
    assert here.velocity == pytest.approx(there.velocity, abs=1e-6, nan_ok=True)


@methods
@given(seed=SEEDS)
def test_velocity_is_displacement_over_the_interval(method, seed):
    scene = cluttered(seed)
    one, half = flow_of(scene, 1.0, method=method), flow_of(scene, 0.5, method=method)
    assert one.label.tolist() == half.label.tolist()
    assert np.array_equal(2 * one.velocity, half.velocity, equal_nan=True)


@given(seed=SEEDS, delta=st.floats(0, 0.3), more=st.floats(0, 0.3))
def test_a_larger_delta_only_turns_moving_into_stationary(seed, delta, more):
    scene = cluttered(seed)
    less, greater = flow_of(scene, delta=delta), flow_of(scene, delta=delta + more)
    changed = less.label != greater.label
    assert (less.label[changed] == Label.MOVING).all()
    assert (greater.label[changed] == Label.STATIONARY).all()
    both = greater.moving
    assert np.array_equal(less.velocity[both], greater.velocity[both])


@given(seed=SEEDS)
def test_delta_at_its_maximum_leaves_nothing_moving(seed):
    flow = flow_of(cluttered(seed), delta=10.0)
    assert not flow.moving.any()
    assert np.isnan(flow.velocity).all()


@given(seed=SEEDS, gamma=st.floats(0, 1), more=st.floats(0, 1))
def test_a_larger_gamma_only_adds_rounds_and_removals(seed, gamma, more):
    scene = cluttered(seed)
    less, greater = flow_of(scene, gamma=gamma), flow_of(scene, gamma=min(1.0, gamma + more))
    for before, after in zip(less.clusters, greater.clusters, strict=True):
        assert len(before.rounds) <= len(after.rounds)
        assert set(before.removed) <= set(after.removed)
        for one, other in zip(before.rounds, after.rounds, strict=False):
            assert one.transformation.tolist() == other.transformation.tolist()


@methods
@given(seed=SEEDS, n_min=st.integers(1, 100), more=st.integers(0, 100))
def test_a_larger_n_min_only_takes_flow_away(method, seed, n_min, more):
    scene = cluttered(seed)
    less = flow_of(scene, method=method, n_min=n_min)
    greater = flow_of(scene, method=method, n_min=n_min + more)
    assert less.moving[greater.moving].all()
    assert np.array_equal(less.velocity[greater.moving], greater.velocity[greater.moving])


@methods
@given(seed=SEEDS)
def test_the_same_input_gives_the_same_result(method, seed):
    scene = cluttered(seed)
    one, again = flow_of(scene, method=method), flow_of(scene, method=method)
    assert one.label.tolist() == again.label.tolist()
    assert np.array_equal(one.velocity, again.velocity, equal_nan=True)
    assert [c.reason for c in one.clusters] == [c.reason for c in again.clusters]


def test_clouds_with_points_are_as_good_as_arrays():
    class Cloud:
        def __init__(self, points: np.ndarray) -> None:
            self.points = points

    scene = cluttered(3)
    arrays = flow_of(scene)
    clouds = estimate_scene_flow(
        Cloud(scene.source), Cloud(scene.target), INTERVAL, Parameters(n_min=20)
    )
    assert arrays.moving.any()
    assert np.array_equal(arrays.velocity, clouds.velocity, equal_nan=True)


def test_the_clouds_are_left_as_they_were():
    scene = cluttered(3)
    source, target = scene.source.copy(), scene.target.copy()
    flow_of(scene)
    assert (source == scene.source).all()
    assert (target == scene.target).all()
