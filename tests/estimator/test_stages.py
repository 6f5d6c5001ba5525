"""Cached stages of a window make estimates faster and leave their results unchanged."""

import dataclasses
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from estimator import (
    Parameters,
    SceneFlow,
    Window,
    estimate,
    estimate_scene_flow,
    window_of_pair,
)
from estimator.stages import Stages
from tests.estimator.scenes import cluttered, methods_of_points

INTERVAL = 8 / 15

walks = st.lists(
    st.builds(
        dict,
        gamma=st.sampled_from([0.0, 0.3, 0.6, 0.7, 0.95, 1.0]),
        delta=st.sampled_from([0.0, 0.02, 0.04, 0.1, 1.0]),
        n_min=st.sampled_from([1, 20, 60, 200]),
        method=st.sampled_from(methods_of_points()),
        min_cluster_size=st.sampled_from([5, 20, 21]),
        min_samples=st.sampled_from([None, 4]),
        allow_single_cluster=st.booleans(),
        max_correspondence_distance=st.sampled_from([0.05, 0.1]),
    ),
    min_size=2,
    max_size=8,
)


def contents(value: Any) -> Any:
    """All numbers of a result bit by bit, NaN included."""
    if isinstance(value, np.ndarray):
        return value.dtype.str, value.shape, value.tobytes()
    if isinstance(value, tuple):
        return tuple(contents(item) for item in value)
    if dataclasses.is_dataclass(value):
        return tuple(contents(getattr(value, f.name)) for f in dataclasses.fields(value))
    return np.float64(value).tobytes() if isinstance(value, float) else value


@pytest.fixture
def clusterings(counting):
    return counting.clusterings


@pytest.fixture
def icps(counting):
    return counting.icps


def pair_of(seed: int) -> Window:
    scene = cluttered(seed)
    return window_of_pair(scene.source, scene.target, INTERVAL)


@given(seed=st.integers(0, 999), walk=walks)
@settings(max_examples=30)
def test_a_walk_over_parameters_finds_what_each_estimate_finds_alone(seed, walk):
    scene, window = cluttered(seed), pair_of(seed)
    for values in walk:
        parameters = Parameters(**values)
        alone = estimate_scene_flow(scene.source, scene.target, INTERVAL, parameters)
        assert contents(estimate(window, parameters)) == contents(alone)


def with_rounds(seed: int = 4) -> tuple[Window, SceneFlow]:
    """A window whose estimate took several rounds over some cluster."""
    window = pair_of(seed)
    flow = estimate(window, Parameters(gamma=0.95, n_min=5))
    assert max(len(cluster.rounds) for cluster in flow.clusters) > 2
    return window, flow


def test_lower_thresholds_need_nothing_new(clusterings, icps):
    window, _ = with_rounds()
    clusterings.clear()
    icps.clear()
    for gamma, delta, n_min in ((0.95, 0.1, 5), (0.7, 0.0, 60), (0.0, 0.04, 20)):
        estimate(window, Parameters(gamma=gamma, delta=delta, n_min=n_min))
    assert clusterings == icps == []


def test_a_higher_gamma_goes_on_where_the_lower_one_stopped(clusterings, icps):
    window = pair_of(4)
    before = estimate(window, Parameters(gamma=0.3, n_min=5))
    done = len(icps)
    after = estimate(window, Parameters(gamma=0.95, n_min=5))
    assert len(clusterings) == 1
    assert done == sum(len(cluster.rounds) for cluster in before.clusters)
    assert len(icps) == sum(len(cluster.rounds) for cluster in after.clusters) > done


def test_a_smaller_n_min_looks_at_the_clusters_that_were_skipped(clusterings, icps):
    window = pair_of(4)
    before = estimate(window, Parameters(gamma=0.0, n_min=100))
    after = estimate(window, Parameters(gamma=0.0, n_min=5))
    seen = [sum(bool(c.rounds) for c in flow.clusters) for flow in (before, after)]
    assert len(icps) == seen[1] > seen[0]
    assert len(clusterings) == 1


def test_the_baseline_takes_clusters_and_first_rounds_from_the_paper(clusterings, icps):
    window, _ = with_rounds()
    done = len(icps)
    estimate(window, Parameters(method="baseline", n_min=5))
    assert (len(clusterings), len(icps)) == (1, done)


@pytest.mark.parametrize(
    "values", [{"min_cluster_size": 21}, {"min_samples": 4}, {"allow_single_cluster": True}]
)
def test_every_setting_of_the_clustering_clusters_anew(values, clusterings):
    window = pair_of(0)
    for parameters in (Parameters(), Parameters(**values), Parameters(), Parameters(**values)):
        estimate(window, parameters)
    assert len(clusterings) == 2


def test_another_reach_of_icp_is_another_round(icps):
    window, _ = with_rounds()
    done = len(icps)
    parameters = Parameters(gamma=0.95, n_min=5, max_correspondence_distance=0.2)
    flow = estimate(window, parameters)
    assert len(icps) == done + sum(len(cluster.rounds) for cluster in flow.clusters)


def test_an_estimate_of_plain_clouds_remembers_nothing(clusterings):
    scene = cluttered(0)
    for _ in range(2):
        estimate_scene_flow(scene.source, scene.target, INTERVAL, Parameters())
    assert len(clusterings) == 2


def test_it_is_known_what_was_asked_for_again():
    stages = Stages()
    for key, reused in (("a", 0), ("b", 0), ("a", 1), ("a", 2), ("c", 2)):
        stages.get(key, lambda: 1.0)
        assert stages.reused == reused
    window = pair_of(0)
    estimate(window, Parameters())
    first = window.stages.reused
    estimate(window, Parameters(delta=0.1))
    assert window.stages.reused > first


def test_what_is_remembered_of_a_pair_is_bounded():
    stages, made = Stages(), []

    def result(key):
        return stages.get(key, lambda: made.append(key) or key)

    for key in range(2000):
        assert result(key) == key
        assert result("kept") == "kept"
    assert len(stages) < 1000
    assert made.count("kept") == 1
    result(0)
    assert made.count(0) == 2
