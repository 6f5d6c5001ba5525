from typing import Any

import numpy as np
import pytest

from app.estimates import Estimates
from app.panels.timeline_strip import strip
from app.playback_clock import Playback
from app.timeline import Timeline, gaps, neighbour, stretches
from estimator import Parameters
from tests.app.fake_recordings import FRAMES, SPEED, fake_opened, fake_recording


def still_and_moving() -> Any:
    """A recording whose truth moves in frames 5 to 9 and 20 to 29; the first 3 are nowhere."""
    recording = fake_recording()
    recording.truth = lambda k: SPEED if 5 <= k < 10 or 20 <= k < 30 else np.zeros(3)
    pose = recording.T_fixed_sensor
    recording.T_fixed_sensor = lambda k: pose(k) * (np.nan if k < 3 else 1.0)
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


def test_a_gap_is_more_than_one_and_a_half_median_intervals():
    assert gaps(np.array([0.0, 1.0, 2.0, 3.4, 4.4, 6.0, 7.0])) == (5,)
    assert gaps(np.array([3.0])) == ()


def test_neighbours_of_a_frame():
    moving = ((5, 9), (20, 29))
    assert [neighbour(moving, k, 1) for k in (0, 5, 12, 20, 33)] == [5, 20, 20, None, None]
    assert [neighbour(moving, k, -1) for k in (0, 5, 7, 20, 33)] == [None, None, 5, 5, 20]


def test_the_truth_and_the_poses_fill_the_timeline():
    timeline = Estimates().timeline(fake_opened(still_and_moving()), Parameters())
    assert timeline == Timeline(FRAMES, (), ((0, 2),), ((5, 9), (20, 29)))


def test_without_truth_the_known_estimates_do():
    recording = fake_recording()
    recording.has_truth = False
    opened, estimates = fake_opened(recording), Estimates()
    assert estimates.timeline(opened, Parameters()).moving == ()
    for k in (3, 10, 11):
        estimates.estimated(opened, k, Parameters())
    assert estimates.timeline(opened, Parameters()).moving == ((10, 11),)
    assert estimates.timeline(opened, Parameters(delta=0.5)).moving == ()


def test_the_strip_names_what_it_shows_and_nothing_else():
    drawn = strip(Timeline(40, (7,), (), ((5, 9),)), Playback(0, 39), "")
    assert "moving" in drawn
    assert "gap" in drawn
    assert "empty" not in drawn
    assert "empty" in strip(Timeline(40, (), ((0, 1),), ()), Playback(0, 39), "")


def test_the_strip_of_a_single_frame_is_drawn():
    assert "<rect" in strip(Timeline(1, (), (), ((0, 0),)), Playback(0, 0), "")
