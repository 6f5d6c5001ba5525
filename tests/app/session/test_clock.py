from collections.abc import Iterable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.errors import InputError
from app.session.clock import LONGEST_WAIT, SHORT, Playback, PlaybackClock

STAMPS = [100.0, 100.1, 100.2, 100.5, 100.6]


def once(stamps: Iterable[float] = STAMPS) -> PlaybackClock:
    """A clock that plays a short recording once."""
    clock = PlaybackClock(stamps)
    clock.change({"loop": False}, 0, now=0.0)
    return clock


def test_it_stands_still_at_first():
    clock = once()
    assert not clock.playing
    assert clock.wait(0, 0.0) is None


def test_frames_come_in_the_recordings_own_time_gaps_included():
    clock = once()
    clock.play(1, now=50.0)
    assert [clock.advance(50.0 + t) for t in (0.0, 0.05, 0.11, 0.39, 0.41, 9.0)] == [
        1,
        1,
        2,
        2,
        3,
        4,
    ]


def test_who_comes_late_skips_frames():
    clock = once()
    clock.play(0, now=0.0)
    assert clock.advance(0.45) == 2
    assert clock.wait(2, 0.45) == pytest.approx(0.05)
    assert clock.wait(0, 0.45) == 0


def test_it_ends_at_the_last_frame():
    clock = once()
    clock.play(3, now=0.0)
    assert clock.advance(0.05) == 3
    assert clock.playing
    assert clock.advance(0.11) == 4
    assert not clock.playing
    assert clock.wait(4, 0.11) is None


def test_twice_the_speed_takes_half_the_time():
    clock = once()
    clock.change({"speed": 2.0}, 0, now=0.0)
    clock.play(0, now=0.0)
    assert clock.wait(0, 0.0) == pytest.approx(0.05)
    assert [clock.advance(t) for t in (0.04, 0.06, 0.11, 0.24, 0.26)] == [0, 1, 2, 2, 3]


def test_a_change_of_speed_goes_on_from_where_it_is():
    clock = once()
    clock.play(0, now=0.0)
    for t in (0.01, 0.03, 0.05):  # in the middle between two frames
        clock.change({"speed": 0.5 if t == 0.05 else 1.0}, 0, now=t)
    assert clock.wait(0, 0.05) == pytest.approx(0.1, abs=1e-4)
    assert [clock.advance(t) for t in (0.14, 0.16)] == [0, 1]


def test_a_loop_shows_the_last_frame_for_a_period_and_begins_again():
    clock = PlaybackClock(STAMPS)
    clock.change({"loop": True, "first": 1, "last": 2}, 1, now=0.0)
    clock.play(1, now=0.0)
    assert [clock.advance(t) for t in (0.05, 0.11, 0.19)] == [1, 2, 2]
    assert clock.wait(2, 0.11) == pytest.approx(0.09, abs=1e-4)
    assert [clock.advance(t) for t in (0.21, 0.25, 0.32, 0.42)] == [1, 1, 2, 1]
    assert clock.playing


def test_a_range_ends_playback_and_beyond_it_the_recording_does():
    clock = once()
    clock.change({"first": 1, "last": 2}, 0, now=0.0)
    clock.play(0, now=0.0)
    assert clock.advance(9.0) == 2
    assert not clock.playing
    clock.play(3, now=0.0)
    assert clock.advance(9.0) == 4


@pytest.mark.parametrize(("asked", "kept"), [((0, 1), (0, 0)), ((-3, 9), (0, 0)), ((7, 2), (0, 0))])
def test_a_range_is_kept_within_the_recording(asked, kept):
    clock = PlaybackClock([100.0])
    clock.change({"first": asked[0], "last": asked[1]}, 0, now=0.0)
    assert (clock.playback.first, clock.playback.last) == kept
    clock.play(0, now=0.0)
    assert clock.advance(0.5) == 0
    longer = once()
    longer.change({"first": 3, "last": 1}, 0, now=0.0)
    assert (longer.playback.first, longer.playback.last) == (1, 1)


def test_one_frame_loops_without_haste():
    clock = PlaybackClock([100.0])
    clock.change({"loop": True}, 0, now=0.0)
    clock.play(0, now=0.0)
    assert clock.wait(0, 0.0) == pytest.approx(0.1, abs=1e-4)
    assert clock.advance(0.2) == 0
    assert clock.playing


def test_short_recordings_loop_unless_one_chooses_otherwise():
    short, long = np.arange(0.0, SHORT, 0.5), np.arange(0.0, SHORT + 0.5, 0.5)
    assert PlaybackClock(short).playback == Playback(0, len(short) - 1, loop=True)
    assert PlaybackClock(long).playback == Playback(0, len(long) - 1, loop=False)
    clock = PlaybackClock(short)
    clock.change({"loop": False}, 0, now=0.0)
    assert not clock.playback.loop


def test_the_speed_outlives_a_recording_and_range_and_loop_do_not():
    long = np.arange(0.0, 2 * SHORT)
    clock = PlaybackClock(STAMPS)
    clock.change({"speed": 5.0, "first": 2, "last": 3}, 0, now=0.0)
    assert PlaybackClock(long, like=clock.playback).playback == Playback(0, 19, 5.0, False)
    clock.change({"loop": False}, 0, now=0.0)
    assert PlaybackClock(STAMPS[:3], like=clock.playback).playback == Playback(0, 2, 5.0, True)


def test_a_last_frame_that_was_missed_is_still_waited_for():
    clock = once()
    clock.play(0, now=0.0)
    assert clock.wait(3, 7.0) == 0


def test_pause_stops_time():
    clock = once()
    clock.play(0, now=0.0)
    clock.pause()
    assert not clock.playing
    assert clock.wait(0, 1.0) is None


@given(
    gaps=st.lists(st.floats(0.001, 2.0), min_size=1, max_size=30),
    start=st.integers(0, 29),
    origin=st.floats(-1e6, 1e6),
)
def test_after_each_wait_the_next_frame_is_due(gaps, start, origin):
    stamps = 1.7e9 + np.cumsum(gaps)
    clock = once(stamps)
    frame = start % len(stamps)
    now = origin
    clock.play(frame, now)
    while (wait := clock.wait(frame, now)) is not None:
        now += wait
        assert clock.advance(now) == frame + 1
        frame += 1
    assert frame == len(stamps) - 1


def test_a_jump_by_years_is_waited_for_bit_by_bit():
    clock = PlaybackClock(np.array([0.0, 1.7e9, 1.7e9 + 0.1]))
    clock.change({"speed": 0.1}, 0, 0.0)
    clock.play(0, 0.0)
    assert clock.wait(0, 0.0) == LONGEST_WAIT
    assert clock.advance(LONGEST_WAIT) == 0
    assert clock.playing


@pytest.mark.parametrize("speed", [0.0, -1.0, float("nan"), float("inf"), 3.0])
def test_a_speed_that_is_not_offered_is_refused(speed):
    clock = PlaybackClock(np.arange(5.0))
    with pytest.raises(InputError, match=r"Speed must be one of 0\.1, 0\.25"):
        clock.change({"speed": speed}, 0, 0.0)
    assert clock.playback.speed == 1.0


def test_what_comes_next_is_known_before_it_is_due():
    clock = once()
    assert clock.coming(0.0, 0.0, count=2) == []
    clock.play(0, now=50.0)
    assert clock.coming(50.0, 0.0, count=2) == [1, 2]
    assert clock.coming(50.05, 0.0, count=3) == [1, 2]  # it is 0.3 s to the one after
    assert clock.advance(50.0) == 0  # as if it had not been asked


def test_who_draws_slowly_or_fast_forward_comes_to_frames_further_on():
    clock = once(np.arange(100) / 10)
    clock.play(0, now=50.0)
    assert clock.coming(50.0, 0.25, count=2) == [2, 5]
    clock.change({"speed": 5.0}, 0, now=50.0)
    assert clock.coming(50.0, 0.06, count=2) == [3, 6]
    assert clock.coming(69.0, 0.06, count=2) == [99]
