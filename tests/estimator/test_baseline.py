"""The paper's baseline: no gate, every cluster that is large enough moves."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from estimator import Label, Parameters, estimate_scene_flow
from tests.estimator.engines import EXACT, using
from tests.estimator.judge import judge
from tests.estimator.scenes import cluttered, moved_patches

INTERVAL = 8 / 15


def test_everything_moves_also_what_is_static():
    displacements = np.array([(0.08, 0, 0), (0, 0, 0), (0, 0, 0)])
    scene = moved_patches(np.random.default_rng(0), displacements)
    flow = estimate_scene_flow(scene.source, scene.target, INTERVAL, Parameters(method="baseline"))
    assert flow.moving.all()
    assert flow.velocity == pytest.approx(displacements[scene.patch] / INTERVAL, abs=1e-3)
    assert all(len(cluster.rounds) == 1 for cluster in flow.clusters)


@given(seed=st.integers(0, 2**32 - 1))
def test_no_gate_and_no_removal(seed):
    scene = cluttered(seed)
    flow = estimate_scene_flow(
        scene.source,
        scene.target,
        INTERVAL,
        Parameters(method="baseline", gamma=1.0, delta=10.0, n_min=30),
    )
    for cluster in flow.clusters:
        large = max(len(cluster.source), len(cluster.target)) >= 30
        fit_for_icp = min(len(cluster.source), len(cluster.target)) >= 3
        moves = large and fit_for_icp
        assert cluster.label == (Label.MOVING if moves else Label.UNASSIGNED)
        assert cluster.remaining.tolist() == cluster.source.tolist()
        assert len(cluster.rounds) == int(moves)


@given(seed=st.integers(0, 2**32 - 1))
def test_its_round_is_the_first_of_algorithm_1(seed):
    scene = cluttered(seed)
    clouds = (scene.source, scene.target, INTERVAL)
    plain = estimate_scene_flow(*clouds, Parameters(method="baseline", n_min=20))
    paper = estimate_scene_flow(*clouds, Parameters(n_min=20))
    assert plain.cluster.tolist() == paper.cluster.tolist()
    for one, other in zip(plain.clusters, paper.clusters, strict=True):
        for first, again in zip(one.rounds, other.rounds[:1], strict=True):
            assert first.transformation.tolist() == again.transformation.tolist()
            assert first.fitness == again.fitness


@pytest.mark.parametrize("engine", EXACT, ids=lambda engine: engine.name)
def test_a_second_implementation_says_the_same(engine):
    for seed in range(40):
        scene = cluttered(seed)
        with using(engine):
            flow = estimate_scene_flow(
                scene.source, scene.target, INTERVAL, Parameters(method="baseline")
            )
        label, velocity = judge(scene.source, scene.target, INTERVAL, gate=False)
        assert flow.label.tolist() == label.tolist(), f"scene {seed}"
        assert flow.velocity == pytest.approx(velocity, abs=1e-9, nan_ok=True), f"scene {seed}"
