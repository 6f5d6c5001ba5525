"""Surveys from kept rounds are those from estimates, to the last bit."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import app.analysis.kept_rounds
from app.analysis.estimates import Estimates
from app.analysis.kept_rounds import KeptRounds, without_thresholds
from app.analysis.library import Opened
from app.analysis.survey import Survey
from estimator import Parameters
from recordings import open_recording, sample_paths
from tests.app.fake_recordings import fake_opened, fake_recording
from tests.recordings.room import write_room

PARAMETERS = st.builds(
    Parameters, gamma=st.floats(0, 1), delta=st.floats(0, 0.2), n_min=st.integers(1, 200)
)
ESTIMATES = Estimates()


def kept_of(opened: Opened) -> KeptRounds:
    """Every second pair of a recording."""
    parameters = Parameters()
    kept = KeptRounds(opened.recording, parameters)
    for k in range(parameters.n, len(opened.recording), 2):
        keep(opened, kept, k)
    return kept


def keep(opened: Opened, kept: KeptRounds, k: int) -> None:
    assert kept.wants(k)
    survey = Survey(opened.recording, Parameters())
    pair = ESTIMATES.estimated(opened, k, Parameters())
    survey.put(k, pair)
    kept.put(pair, ESTIMATES.all_rounds(opened, k, Parameters()), survey)
    assert not kept.wants(k)


def check(opened: Opened, kept: KeptRounds, parameters: Parameters) -> None:
    """Compare with a survey from estimates."""
    filled, expected = (Survey(opened.recording, parameters) for _ in range(2))
    kept.fill(filled)
    for k in range(parameters.n, len(opened.recording), 2):
        expected.put(k, ESTIMATES.estimated(opened, k, parameters))
    for name, values in vars(expected).items():
        if isinstance(values, np.ndarray):
            np.testing.assert_array_equal(getattr(filled, name), values, err_msg=name)
    for name, values in expected.metrics.items():
        np.testing.assert_array_equal(filled.metrics[name], values, err_msg=name)
    assert filled.summary() == expected.summary()


@pytest.fixture(scope="module", params=[path.stem for path in sample_paths()])
def sample(request: pytest.FixtureRequest) -> Iterator[tuple[Opened, KeptRounds]]:
    """A sample and its rounds."""
    [path] = [path for path in sample_paths() if path.stem == request.param]
    with open_recording(path) as recording:
        opened = fake_opened(recording)
        yield opened, kept_of(opened)


@settings(max_examples=10, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(parameters=PARAMETERS)
def test_any_thresholds_give_what_estimates_give(sample, parameters):
    opened, kept = sample
    check(opened, kept, parameters)


def test_thresholds_at_which_things_move_or_do_not(sample):
    opened, kept = sample
    found = []
    for change in ({}, {"gamma": 0.3}, {"gamma": 0.95}, {"delta": 0.15}, {"n_min": 10}):
        parameters = replace(Parameters(), **change)
        check(opened, kept, parameters)
        survey = Survey(opened.recording, parameters)
        kept.fill(survey)
        found.append(np.nansum(survey.moving))
    assert len(set(found)) > 1


def test_a_recording_whose_object_rests_at_first_and_others_without_truth(tmp_path):
    path = write_room(tmp_path / "room.mcap", frames=16, rests=5).path
    with open_recording(path) as recording:
        opened = fake_opened(recording)
        check(opened, kept_of(opened), Parameters(gamma=0.5))
    for points_known in (True, False):
        fake = fake_recording()
        if points_known:
            fake.truth = lambda k: np.zeros(3) if k < 20 else np.array([0.0, 0.15, 0.0])
        else:
            fake.has_truth, fake.truth, fake.pair_truth = False, lambda _: None, lambda *_: None
        opened = fake_opened(fake)
        check(opened, kept_of(opened), Parameters(delta=0.06))


def test_before_anything_is_kept_nothing_is_filled():
    survey = Survey(fake_recording(), Parameters())
    KeptRounds(fake_recording(), Parameters()).fill(survey)
    assert not survey.done[8:].any()


def test_rounds_of_a_bounded_number_of_pairs_are_kept(monkeypatch):
    monkeypatch.setattr(app.analysis.kept_rounds, "MOST", 2)
    opened = fake_opened()
    kept = KeptRounds(opened.recording, Parameters())
    for k in (20, 21):
        keep(opened, kept, k)
    assert not kept.wants(22)


def test_only_the_thresholds_of_algorithm_1_leave_the_rounds_as_they_are():
    default = Parameters()
    changed = replace(default, gamma=0.1, delta=0.2, n_min=3)
    assert without_thresholds(changed) == without_thresholds(default)
    assert without_thresholds(replace(default, n=5)) != without_thresholds(default)
    assert without_thresholds(replace(default, method="baseline")) is None
