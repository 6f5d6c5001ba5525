import threading
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from app.analysis import live_timeline
from app.analysis.estimates import Estimates
from app.analysis.library import Opened
from app.analysis.live_timeline import LiveTimeline
from app.analysis.surveys import Surveys
from app.analysis.timeline import Timeline, gaps, has_counting_pair, neighbour, stretches
from app.analysis.true_motions import TrueMotions
from estimator import Parameters
from tests.app.fake_recordings import FRAMES, SPEED, fake_opened, fake_recording
from tests.app.waiting import until


def still_and_moving() -> Any:
    """A recording whose truth moves in frames 5 to 9 and 20 to 29; the first 3 are nowhere."""
    recording = fake_recording()
    recording.truth = lambda k: SPEED if 5 <= k < 10 or 20 <= k < 30 else np.zeros(3)
    recording.unplaced[:3] = True
    return recording


@pytest.mark.parametrize(
    ("flags", "expected"),
    [
        ([], ()),
        ([False], ()),
        ([True], ((0, 0),)),
        ([True, True, False, True], ((0, 1), (3, 3))),
        ([False, True, True], ((1, 2),)),
    ],
)
def test_stretches(flags, expected):
    assert stretches(flags) == expected


def test_a_gap_is_where_a_frame_is_missing_and_no_jitter():
    assert gaps(np.array([0.0, 1.0, 2.0, 3.7, 4.7, 6.6, 7.6])) == (5,)
    assert gaps(np.array([3.0])) == ()


def test_neighbours_of_a_frame():
    moving = ((5, 9), (20, 29))
    assert [neighbour(moving, k, 1) for k in (0, 5, 12, 20, 33)] == [5, 20, 20, None, None]
    assert [neighbour(moving, k, -1) for k in (0, 5, 7, 20, 33)] == [None, None, 5, 5, 20]


def followed(estimates: Estimates, surveys: Surveys) -> LiveTimeline:
    return LiveTimeline(estimates, surveys, TrueMotions(estimates), lambda: None)


def timeline(
    opened: Opened, estimates: Estimates, parameters: Parameters | None = None
) -> Timeline:
    live = followed(estimates, Surveys(estimates))
    return live.of(opened, parameters or Parameters())


def without_truth() -> Any:
    recording = fake_recording()
    recording.has_truth = False
    recording.truth = lambda _: None
    recording.pair_truth = lambda *_: None
    return recording


@pytest.mark.parametrize(
    ("n", "counts"), [(1, True), (4, True), (5, False), (6, True), (12, True), (13, False)]
)
def test_a_pair_counts_where_something_moves_at_both_ends(n, counts):
    timeline = Timeline(20, gaps=(), empty=(), moving=((2, 6), (12, 14)))
    assert has_counting_pair(timeline, n) == counts
    assert not has_counting_pair(timeline, 40)


def test_the_truth_and_the_poses_fill_the_timeline():
    seen = timeline(fake_opened(still_and_moving()), Estimates())
    assert seen == Timeline(FRAMES, (), ((0, 2),), ((5, 9), (20, 29)))


def test_without_truth_the_known_estimates_do():
    opened, estimates = fake_opened(without_truth()), Estimates()
    assert timeline(opened, estimates).moving == ()
    for k in (3, 10, 11):
        estimates.estimated(opened, k, Parameters())
    assert timeline(opened, estimates).moving == ((10, 11),)
    assert timeline(opened, estimates, Parameters(delta=0.5)).moving == ()


def test_a_survey_knows_of_more_frames_than_estimates_are_remembered():
    recording = without_truth()
    cloud = recording.cloud

    def some_empty(k, max_range=4.0):
        seen = cloud(k, max_range)
        nothing = np.zeros(0, dtype=np.int64)
        if k not in (2, 3, 30):
            return seen
        return replace(seen, points=np.zeros((0, 3)), sensor=nothing, zone=nothing)

    recording.cloud = some_empty
    opened, estimates = fake_opened(recording), Estimates(flows=4)
    surveys = Surveys(estimates)
    live, complete = followed(estimates, surveys), threading.Event()
    surveys.request(
        "me", opened, Parameters(), lambda survey: complete.set() if survey.complete else None
    )
    assert complete.wait(60)
    seen = live.of(opened, Parameters())
    assert seen.empty == ((2, 3), (30, 30))
    assert seen.moving == ((8, 9), (12, 29), (31, 37), (39, 39))
    # Others ask for so many that this one is forgotten.
    for n in range(1, 20):
        survey = surveys.request("you", opened, Parameters(n=30, n_min=n), lambda _: None)
        until(lambda survey=survey: survey.complete)
    assert surveys.known(opened, Parameters()) is None
    live._last = None if live._last is None else (*live._last[:1], 0.0, seen)
    assert live.of(opened, Parameters()) == seen


def test_what_a_survey_finds_last_is_in_the_timeline_at_once(monkeypatch):
    monkeypatch.setattr(live_timeline, "_AGE", 3600.0)
    opened, estimates = fake_opened(without_truth()), Estimates()
    surveys, complete = Surveys(estimates), threading.Event()
    live = followed(estimates, surveys)
    assert live.of(opened, Parameters()).moving == ()
    surveys.request(
        "me", opened, Parameters(), lambda survey: complete.set() if survey.complete else None
    )
    assert complete.wait(60)
    assert live.of(opened, Parameters()).moving == ((8, FRAMES - 1),)
