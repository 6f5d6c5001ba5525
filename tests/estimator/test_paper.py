"""Algorithm 1: known motions, the story of its rounds, and a second implementation as judge."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import estimator.paper
from estimator import Label, Parameters, Window, estimate_scene_flow, window_of_pair
from estimator.flow import Cluster
from estimator.paper import classify
from tests.estimator.engines import EXACT, using
from tests.estimator.judge import judge
from tests.estimator.scenes import cluttered, corner, moved_patches

INTERVAL = 8 / 15


@given(
    seed=st.integers(0, 2**32 - 1),
    length=st.floats(0.05, 0.10),
    direction=st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda d: np.linalg.norm(d) > 0.1),
    moving=st.integers(0, 3),
)
def test_a_patch_moved_among_static_ones_gets_that_velocity(seed, length, direction, moving):
    displacements = np.zeros((4, 3))
    displacements[moving] = length * np.array(direction) / np.linalg.norm(direction)
    scene = moved_patches(np.random.default_rng(seed), displacements)
    flow = estimate_scene_flow(scene.source, scene.target, INTERVAL, Parameters())

    moved = scene.patch == moving
    assert (flow.label[moved] == Label.MOVING).all()
    assert (flow.label[~moved] == Label.STATIONARY).all()
    error = flow.velocity[moved] - displacements[moving] / INTERVAL
    assert np.linalg.norm(error, axis=1).max() < 1e-3
    assert np.isnan(flow.velocity[~moved]).all()


def test_several_patches_move_each_in_its_own_way():
    displacements = np.array([(0.06, 0, 0), (0, -0.08, 0.03), (0, 0, 0), (-0.05, 0.05, 0.05)])
    scene = moved_patches(np.random.default_rng(1), displacements)
    flow = estimate_scene_flow(scene.source, scene.target, INTERVAL, Parameters())
    expected = displacements[scene.patch] / INTERVAL
    moves = scene.patch != 2
    assert (flow.moving == moves).all()
    assert flow.velocity[moves] == pytest.approx(expected[moves], abs=1e-3)


@pytest.mark.parametrize(("length", "label"), [(0.039, Label.STATIONARY), (0.041, Label.MOVING)])
def test_delta_is_where_motion_begins(length, label):
    scene = moved_patches(np.random.default_rng(0), np.array([(length, 0, 0), (0, 0, 0)]))
    flow = estimate_scene_flow(scene.source, scene.target, INTERVAL, Parameters(delta=0.04))
    assert (flow.label[scene.patch == 0] == label).all()
    assert (flow.label[scene.patch == 1] == Label.STATIONARY).all()


def test_a_mean_displacement_of_just_delta_moves():
    # The pseudocode: stationary below δ, moving otherwise.
    scene = moved_patches(np.random.default_rng(0), np.array([(0.06, 0, 0), (0, 0, 0)]))
    flow = estimate_scene_flow(scene.source, scene.target, INTERVAL, Parameters())
    (moved,) = [cluster for cluster in flow.clusters if cluster.label == Label.MOVING]
    for delta, moves in (
        (moved.mean_displacement, True),
        (np.nextafter(moved.mean_displacement, 1.0), False),
    ):
        again = estimate_scene_flow(
            scene.source, scene.target, INTERVAL, Parameters(delta=float(delta))
        )
        assert (again.moving == (scene.patch == 0)).all() == moves
        assert again.moving.any() == moves


def whole(source: np.ndarray, target: np.ndarray) -> tuple[Cluster, Window]:
    """Two clouds as one cluster, without HDBSCAN."""
    window = window_of_pair(source, target, INTERVAL)
    return Cluster(0, np.arange(len(source)), np.arange(len(target))), window


@pytest.mark.parametrize(("paired", "label"), [(7, Label.UNASSIGNED), (8, Label.STATIONARY)])
def test_fitness_must_be_above_gamma(paired, label):
    source = np.arange(10)[:, None] * (1.0, 0.3, 0.1)
    target = source.copy()
    target[paired:] += (0.0, 50.0, 0.0)
    result = classify(*whole(source, target), Parameters(gamma=0.7, n_min=1))
    assert result.rounds[0].fitness == paired / 10
    assert result.label == label


def two_ways() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A cluster of which 60 points move by +0.09 m and 40 by -0.09 m; the mask is of the 60."""
    lattice = np.stack(np.meshgrid(*[np.arange(5.0)] * 3), axis=-1).reshape(-1, 3)[:100]
    lattice += np.random.default_rng(0).uniform(-0.1, 0.1, lattice.shape)
    with_most = np.random.default_rng(1).permutation(100) < 60
    sign = np.where(with_most, 1.0, -1.0)[:, None]
    return lattice, lattice + sign * (0.09, 0.0, 0.0), with_most


def test_the_story_of_rounds():
    source, target, with_most = two_ways()
    result = classify(*whole(source, target), Parameters(n_min=30))
    first, second = result.rounds

    assert first.fitness == 0.6
    assert first.inlier_source.tolist() == np.flatnonzero(with_most).tolist()
    assert first.inlier_target.tolist() == np.flatnonzero(with_most).tolist()
    assert first.transformation[:3, 3] == pytest.approx((0.09, 0, 0), abs=1e-3)

    assert (second.source_size, second.target_size) == (40, 40)
    assert second.fitness == 1.0
    assert second.transformation[:3, 3] == pytest.approx((-0.09, 0, 0), abs=1e-3)

    assert result.label == Label.MOVING
    assert result.remaining.tolist() == np.flatnonzero(~with_most).tolist()
    assert result.removed.tolist() == np.flatnonzero(with_most).tolist()
    assert result.velocity == pytest.approx(np.tile([-0.09 / INTERVAL, 0, 0], (40, 1)), abs=1e-3)
    assert (result.fitness, result.mean_displacement) == (second.fitness, second.mean_displacement)
    assert result.reason == (
        "Moving: fitness 1.00 above γ 0.7, mean displacement 0.090 m not below δ 0.04 m."
    )


def test_n_min_is_tested_again_in_each_round():
    source, target, with_most = two_ways()
    result = classify(*whole(source, target), Parameters(n_min=41))
    assert len(result.rounds) == 1
    assert result.label == Label.UNASSIGNED
    assert result.remaining.tolist() == np.flatnonzero(~with_most).tolist()
    assert result.reason == ("Unassigned: 40 source and 40 target points, both below N_min 41.")


def test_gamma_decides_in_which_round_it_ends():
    source, target, with_most = two_ways()
    result = classify(*whole(source, target), Parameters(n_min=30, gamma=0.5))
    assert len(result.rounds) == 1
    assert result.label == Label.MOVING
    assert len(result.remaining) == 100
    assert with_most.sum() == len(result.rounds[0].inlier_source)


def test_nothing_in_reach_is_unassigned():
    source = corner(np.random.default_rng(0))
    result = classify(*whole(source, source + 3.0), Parameters())
    assert (len(result.rounds), result.fitness) == (1, 0.0)
    assert result.label == Label.UNASSIGNED
    assert len(result.remaining) == 100
    assert result.reason == "Unassigned: no point is near enough to the other cloud to be paired."


def test_gamma_of_one_is_never_exceeded():
    source = corner(np.random.default_rng(0))
    result = classify(*whole(source, source), Parameters(gamma=1.0))
    assert result.rounds[0].fitness == 1.0
    assert result.label == Label.UNASSIGNED
    assert len(result.remaining) == 0


def test_rounds_are_bounded(monkeypatch):
    source, target, with_most = two_ways()
    assert estimator.paper.MAX_ROUNDS == 20
    monkeypatch.setattr(estimator.paper, "MAX_ROUNDS", 1)
    result = classify(*whole(source, target), Parameters(n_min=30))
    assert len(result.rounds) == 1
    assert result.label == Label.UNASSIGNED
    assert result.removed.tolist() == np.flatnonzero(with_most).tolist()
    assert result.reason == "Unassigned: fitness not above γ 0.7 in 1 rounds."


@pytest.mark.parametrize("engine", EXACT, ids=lambda engine: engine.name)
@pytest.mark.parametrize("n_min", [20, 60])
def test_a_second_implementation_says_the_same(n_min, engine):
    labels = np.zeros(3, dtype=int)
    for seed in range(60):
        scene = cluttered(seed)
        with using(engine):
            flow = estimate_scene_flow(
                scene.source, scene.target, INTERVAL, Parameters(n_min=n_min)
            )
        label, velocity = judge(scene.source, scene.target, INTERVAL, n_min=n_min)
        assert flow.label.tolist() == label.tolist(), f"scene {seed}"
        assert flow.velocity == pytest.approx(velocity, abs=1e-9, nan_ok=True), f"scene {seed}"
        labels += np.bincount(label, minlength=3)
    assert (labels > 1000).all(), "the scenes must show every label"


@pytest.mark.parametrize("engine", EXACT, ids=lambda engine: engine.name)
@given(
    seed=st.integers(0, 2**32 - 1),
    gamma=st.floats(0, 1),
    delta=st.floats(0, 0.2),
    n_min=st.integers(1, 100),
    reach=st.floats(0.01, 0.5),
    min_cluster_size=st.integers(2, 50),
)
def test_a_second_implementation_says_the_same_for_any_parameters(
    engine, seed, gamma, delta, n_min, reach, min_cluster_size
):
    scene = cluttered(seed)
    parameters = Parameters(
        gamma=gamma,
        delta=delta,
        n_min=n_min,
        max_correspondence_distance=reach,
        min_cluster_size=min_cluster_size,
    )
    with using(engine):
        flow = estimate_scene_flow(scene.source, scene.target, INTERVAL, parameters)
    label, velocity = judge(
        scene.source,
        scene.target,
        INTERVAL,
        gamma=gamma,
        delta=delta,
        n_min=n_min,
        reach=reach,
        min_cluster_size=min_cluster_size,
    )
    assert flow.label.tolist() == label.tolist()
    assert flow.velocity == pytest.approx(velocity, abs=1e-9, nan_ok=True)
