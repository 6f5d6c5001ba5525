"""The true motion of long recordings, which a thread reads while others look."""

import threading
from typing import Any

import numpy as np
import pytest

from app.analysis import live_timeline, true_motions
from app.analysis.estimates import Estimates
from app.analysis.library import Opened
from app.analysis.live_timeline import LiveTimeline
from app.analysis.surveys import Surveys
from app.analysis.true_motions import TrueMotions
from estimator import Parameters
from recordings import RecordingError
from tests.app.fake_recordings import SPEED, fake_opened, fake_recording
from tests.app.waiting import until

FRAMES = 400
MOVING = tuple((k, k + 9) for k in range(20, FRAMES, 40))


@pytest.fixture(autouse=True)
def _long_and_in_small_pieces(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.analysis.timeline._MOST_AT_ONCE", 100)
    monkeypatch.setattr(true_motions, "_PIECE", 0.0)
    monkeypatch.setattr(true_motions, "_QUIET", 0.0)
    monkeypatch.setattr(true_motions, "_NOTIFY_INTERVAL", 0.0)
    monkeypatch.setattr(live_timeline, "_AGE", 0.0)


class Gate:
    """A recording that moves at times; its truth waits at a frame until it is let go on."""

    def __init__(self, stop: int = FRAMES) -> None:
        self.stop, self.waiting, self.go_on = stop, threading.Event(), threading.Event()
        self.asked: list[int] = []
        recording = fake_recording(frames=FRAMES)
        recording.truth = self._truth
        self.opened: Opened = fake_opened(recording)

    def _truth(self, k: int) -> Any:
        self.asked.append(k)
        if k == self.stop:
            self.waiting.set()
            assert self.go_on.wait(10)
        return SPEED if k % 40 in range(20, 30) else np.zeros(3)


def read(
    estimates: Estimates, motions: TrueMotions, opened: Opened, owner: object = "me"
) -> list[int]:
    """Have the truth read to its end; frames that were known at the notifications."""
    known: list[int] = []
    done = threading.Event()

    def note() -> None:
        timeline = estimates.recorded_timeline(opened)
        known.append(timeline.read)
        if timeline.complete:
            done.set()

    motions.request(owner, opened, note)
    assert estimates.recorded_timeline(opened).complete or done.wait(10)
    return known


def test_it_is_found_in_order_and_told_as_it_comes():
    estimates, gate = Estimates(), Gate()
    known = read(estimates, TrueMotions(estimates), gate.opened)
    assert gate.asked == list(range(FRAMES))
    assert known == sorted(known)
    assert len(known) > 10
    none = np.zeros(FRAMES, dtype=bool)
    assert estimates.recorded_timeline(gate.opened).with_estimates(none, none).moving == MOVING


def test_a_timeline_shows_what_is_read_and_asks_for_nothing_itself():
    estimates, gate, told = Estimates(), Gate(stop=100), threading.Event()
    live = LiveTimeline(estimates, Surveys(estimates), TrueMotions(estimates), told.set)
    first = live.of(gate.opened, Parameters())
    assert first.unread > 0
    assert gate.waiting.wait(10)
    seen = live.of(gate.opened, Parameters())
    assert (seen.moving, seen.unread) == (MOVING[:2], FRAMES - 100)
    told.clear()
    gate.go_on.set()
    until(lambda: live.of(gate.opened, Parameters()).unread == 0)
    assert told.wait(10)
    assert live.of(gate.opened, Parameters()).moving == MOVING
    live.of(gate.opened, Parameters(n=3))  # other parameters read nothing again
    assert len(gate.asked) == FRAMES


def test_all_of_it_is_in_the_timeline_at_once(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(live_timeline, "_AGE", 3600.0)
    estimates, gate, told = Estimates(), Gate(stop=0), threading.Event()
    live = LiveTimeline(estimates, Surveys(estimates), TrueMotions(estimates), told.set)
    assert live.of(gate.opened, Parameters()).unread == FRAMES
    gate.go_on.set()
    until(lambda: estimates.recorded_timeline(gate.opened).complete)
    assert live.of(gate.opened, Parameters()).moving == MOVING


def test_what_a_closed_file_says_is_not_kept():
    estimates, gate = Estimates(), Gate(stop=50)
    motions = TrueMotions(estimates)
    live = LiveTimeline(estimates, Surveys(estimates), motions, lambda: None)
    live.of(gate.opened, Parameters())
    assert gate.waiting.wait(10)
    live.stop()
    gate.go_on.set()
    until(lambda: motions.idle)
    assert estimates.recorded_timeline(gate.opened).read == 50
    assert max(gate.asked) == 50
    read(estimates, motions, gate.opened)  # opened again, it goes on from there
    assert sorted(gate.asked) == [*range(50), 50, *range(50, FRAMES)]


def test_two_sessions_have_it_read_once_and_one_may_leave():
    estimates, gate, told = Estimates(), Gate(stop=50), threading.Event()
    motions = TrueMotions(estimates)
    motions.request("me", gate.opened, lambda: None)
    assert gate.waiting.wait(10)
    motions.request("you", gate.opened, told.set)
    motions.cancel("me")
    gate.go_on.set()
    assert told.wait(10)
    until(lambda: motions.idle)
    assert estimates.recorded_timeline(gate.opened).complete
    assert sorted({*gate.asked}) == list(range(FRAMES))
    assert len(gate.asked) <= FRAMES + 1  # the piece that was read for the one who left


def test_what_is_read_already_is_not_read_for_others():
    estimates, gate = Estimates(), Gate()
    motions = TrueMotions(estimates)
    read(estimates, motions, gate.opened)
    assert read(estimates, motions, gate.opened, "you") == []
    assert len(gate.asked) == FRAMES


def test_broken_frames_have_no_motion():
    estimates, gate = Estimates(), Gate()
    truth = gate.opened.recording.truth

    def broken(k: int) -> Any:
        if k in (25, 26):
            raise RecordingError("broken")
        return truth(k)

    gate.opened.recording.truth = broken  # type: ignore[method-assign]
    read(estimates, TrueMotions(estimates), gate.opened)
    none = np.zeros(FRAMES, dtype=bool)
    moving = estimates.recorded_timeline(gate.opened).with_estimates(none, none).moving
    assert moving == ((20, 24), (27, 29), *MOVING[1:])


def test_a_failure_ends_the_reading_and_is_logged(caplog: pytest.LogCaptureFixture):
    estimates, gate = Estimates(), Gate()

    def failing(k: int) -> Any:
        raise RuntimeError(f"frame {k}")

    gate.opened.recording.truth = failing  # type: ignore[method-assign]
    motions = TrueMotions(estimates)
    motions.request("me", gate.opened, lambda: None)
    until(lambda: motions.idle)
    assert "its truth cannot be read" in caplog.text
    assert estimates.recorded_timeline(gate.opened).read == 0


def test_it_waits_for_what_a_person_waits_for(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(true_motions, "_PATIENCE", 3600.0)
    estimates, gate = Estimates(), Gate()
    motions = TrueMotions(estimates)
    with estimates.foreground:
        motions.request("me", gate.opened, lambda: None)
        assert not gate.waiting.wait(0.2)
        assert gate.asked == []
    until(lambda: estimates.recorded_timeline(gate.opened).complete)
    assert len(gate.asked) == FRAMES
