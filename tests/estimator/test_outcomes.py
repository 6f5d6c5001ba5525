"""Outcomes for any thresholds are those of Algorithm 1 itself."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import estimator.paper
from estimator import Label, Parameters, Window, estimate, window_of_pair
from estimator.outcomes import all_rounds, joined, left_in_states, outcomes, states_of
from tests.estimator.scenes import cluttered

PARAMETERS = st.builds(
    Parameters,
    gamma=st.floats(0, 1),
    delta=st.floats(0, 0.2),
    n_min=st.integers(1, 200),
)


def window(seed: int) -> Window:
    scene = cluttered(seed)
    return window_of_pair(scene.source, scene.target, 0.5)


WINDOWS = [window(seed) for seed in range(4)]


def check(window: Window, asked: Parameters) -> None:
    """Compare outcomes from rounds alone with an estimate."""
    clusters = all_rounds(window, Parameters())
    states = states_of(clusters)
    end, label = outcomes(states, asked)
    results = estimate(window, asked).clusters
    assert label.tolist() == [result.label for result in results]
    for cluster, first, last, result in zip(clusters, states.first, end, results, strict=True):
        left = left_in_states(cluster)[last - first]
        np.testing.assert_array_equal(left, result.remaining)
        assert states.source_size[last] == len(left)


@given(at=st.integers(0, 3), asked=PARAMETERS)
def test_the_outcome_is_that_of_the_loop(at, asked):
    check(WINDOWS[at], asked)


@pytest.mark.parametrize("rounds", [1, 2])
def test_where_the_loop_may_not_go_on_too(rounds, monkeypatch):
    monkeypatch.setattr(estimator.paper, "MAX_ROUNDS", rounds)
    for window in WINDOWS:
        check(window, Parameters(gamma=0.95, n_min=1))


@given(asked=PARAMETERS)
def test_windows_that_are_joined_are_decided_alike(asked):
    parts = [states_of(()), *(states_of(all_rounds(each, Parameters())) for each in WINDOWS)]
    together = joined(parts)
    end, label = outcomes(together, asked)
    alone = [outcomes(part, asked) for part in parts]
    np.testing.assert_array_equal(label, np.concatenate([labels for _, labels in alone]))
    steps = [ends - part.first for (ends, _), part in zip(alone, parts, strict=True)]
    np.testing.assert_array_equal(end - together.first, np.concatenate(steps))


def test_labels_change_with_each_threshold():
    default = Parameters()
    states = joined([states_of(all_rounds(each, default)) for each in WINDOWS])
    _, before = outcomes(states, default)
    assert set(before.tolist()) == set(Label)
    for change in ({"gamma": 0.2}, {"delta": 0.2}, {"n_min": 200}):
        _, after = outcomes(states, replace(default, **change))
        assert (before != after).any(), change


def test_without_clusters_there_is_nothing_to_decide():
    end, label = outcomes(states_of(()), Parameters())
    assert len(end) == len(label) == 0
