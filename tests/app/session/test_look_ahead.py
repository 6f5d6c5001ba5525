"""Frames are estimated before playback comes to them."""

import threading
from typing import Any

import pytest

from app.analysis.estimates import Estimates
from app.session.clock import PlaybackClock
from app.session.look_ahead import LookAhead
from estimator import Parameters
from recordings import RecordingError
from tests.app.fake_recordings import FRAMES, PERIOD, fake_opened, fake_recording


@pytest.fixture
def clock():
    clock = PlaybackClock(100 + PERIOD * k for k in range(FRAMES))
    clock.play(20, now=50.0)
    return clock


def test_the_two_frames_that_come_next_are_estimated(clock):
    estimates, opened = Estimates(), fake_opened()
    ahead = LookAhead(estimates)
    ahead.follow(opened, clock, 50.0, 20, Parameters())
    ahead.stop()
    found = [k for k in range(FRAMES) if estimates.known(opened, k, Parameters())]
    assert found == [21, 22]
    ahead.close()


def test_while_two_are_estimated_no_others_begin(clock):
    estimates: Any = Estimates()
    opened, asked, go_on = fake_opened(), [], threading.Event()

    def estimated(opened, k, parameters):
        asked.append(k)
        go_on.wait(10)

    estimates.estimated = estimated
    ahead = LookAhead(estimates)
    for now in (50.0, 50.0 + PERIOD, 50.0 + 2 * PERIOD):
        ahead.follow(opened, clock, now, 20, Parameters())
    go_on.set()
    ahead.close()
    assert sorted(asked) == [21, 22]


def test_a_frame_that_cannot_be_read_is_left_to_its_drawing(clock):
    fake = fake_recording()

    def broken(*_):
        raise RecordingError("it is broken.")

    fake.cloud = broken
    estimates, opened = Estimates(), fake_opened(fake)
    ahead = LookAhead(estimates)
    ahead.follow(opened, clock, 50.0, 20, Parameters())
    ahead.close()
    assert estimates.known(opened, 21, Parameters()) is None
    with pytest.raises(RecordingError):
        estimates.estimated(opened, 21, Parameters())


def test_when_playback_has_ended_nothing_is_begun(clock):
    estimates, opened = Estimates(), fake_opened()
    ahead = LookAhead(estimates)
    clock.pause()
    ahead.follow(opened, clock, 50.0, 20, Parameters())
    ahead.close()
    assert not any(estimates.known(opened, k, Parameters()) for k in range(FRAMES))


def test_what_is_due_is_drawn_where_it_is_known_or_nothing_was_begun(clock):
    estimates, opened = Estimates(), fake_opened()
    ahead = LookAhead(estimates)
    assert ahead.frame_to_draw(opened, 25, 20, Parameters()) == 25
    ahead.follow(opened, clock, 50.0, 20, Parameters())
    assert ahead.frame_to_draw(opened, 22, 20, Parameters()) == 22  # it is being estimated
    estimates.estimated(opened, 25, Parameters())
    assert ahead.frame_to_draw(opened, 25, 20, Parameters()) == 25
    ahead.close()


def test_who_is_behind_draws_what_was_begun_in_time(clock):
    estimates, opened = Estimates(), fake_opened()
    ahead = LookAhead(estimates)
    ahead.follow(opened, clock, 50.0, 20, Parameters())
    ahead.stop()
    assert ahead.frame_to_draw(opened, 30, 20, Parameters()) == 22
    assert ahead.frame_to_draw(opened, 30, 22, Parameters()) == 30  # no frame is drawn again
    assert ahead.frame_to_draw(opened, 5, 22, Parameters()) == 5  # playback has begun anew
    assert ahead.frame_to_draw(opened, 30, 20, Parameters(n=5)) == 30
    assert ahead.frame_to_draw(fake_opened(), 30, 20, Parameters()) == 30
    ahead.close()


def test_what_was_passed_is_forgotten(clock):
    estimates, opened = Estimates(), fake_opened()
    ahead = LookAhead(estimates)
    for k in range(8):
        ahead.follow(opened, clock, 50.0 + k * PERIOD, 20 + k, Parameters())
        ahead.stop()
    assert len(ahead._begun) <= 3
    ahead.close()
