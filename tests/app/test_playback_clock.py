import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.playback_clock import PlaybackClock

STAMPS = [100.0, 100.1, 100.2, 100.5, 100.6]


def test_it_stands_still_at_first():
    clock = PlaybackClock(STAMPS)
    assert not clock.playing
    assert clock.wait(0, 0.0) is None


def test_frames_come_in_the_recordings_own_time_gaps_included():
    clock = PlaybackClock(STAMPS)
    clock.play(1, now=50.0)
    assert [clock.frame(50.0 + t) for t in (0.0, 0.05, 0.11, 0.39, 0.41, 9.0)] == [1, 1, 2, 2, 3, 4]


def test_who_comes_late_skips_frames():
    clock = PlaybackClock(STAMPS)
    clock.play(0, now=0.0)
    assert clock.frame(0.45) == 2
    assert clock.wait(2, 0.45) == pytest.approx(0.05)
    assert clock.wait(0, 0.45) == 0


def test_it_ends_at_the_last_frame():
    clock = PlaybackClock(STAMPS)
    clock.play(3, now=0.0)
    assert not clock.at_end(0.05)
    assert clock.at_end(0.11)
    assert clock.wait(4, 0.11) is None


def test_a_last_frame_that_was_missed_is_still_waited_for():
    clock = PlaybackClock(STAMPS)
    clock.play(0, now=0.0)
    assert clock.wait(3, 7.0) == 0


def test_pause_stops_time():
    clock = PlaybackClock(STAMPS)
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
    clock = PlaybackClock(stamps)
    frame = start % len(stamps)
    now = origin
    clock.play(frame, now)
    while (wait := clock.wait(frame, now)) is not None:
        now += wait
        assert clock.frame(now) == frame + 1
        frame += 1
    assert frame == len(stamps) - 1
