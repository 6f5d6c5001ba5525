import numpy as np
import pytest

from app.analysis.estimates import Estimates
from app.analysis.first_frame import candidates, first_frame_with_flow
from estimator import Parameters
from tests.app.fake_recordings import FRAMES, SPEED, fake_opened, fake_recording


@pytest.fixture
def long(monkeypatch):
    """All recordings are long ones."""
    monkeypatch.setattr("app.analysis.timeline._MOST_AT_ONCE", 0)


def asked(recording):
    """Note the frames whose truth is asked for."""
    frames, truth = [], recording.truth
    recording.truth = lambda k: (frames.append(k), truth(k))[1]
    return frames


def moving_late():
    """A recording without truth whose patch moves in its last quarter alone."""
    recording = fake_recording()
    cloud, start = recording.cloud, 3 * FRAMES // 4
    recording.cloud = lambda k, max_range=4.0: cloud(max(k - start, 0) * 2, max_range)
    recording.truth = lambda k: None
    recording.pair_truth = lambda *_: None
    return recording


def test_with_truth_it_is_the_middle_of_the_motion():
    recording = fake_recording()
    recording.truth = lambda k: SPEED if 10 <= k < 30 else np.zeros(3)
    assert first_frame_with_flow(fake_opened(recording), Parameters(), Estimates()) == 24


def test_without_truth_it_looks_for_flow():
    opened, estimates = fake_opened(moving_late()), Estimates()
    frame = first_frame_with_flow(opened, Parameters(), estimates)
    flow = estimates.estimated(opened, frame, Parameters()).flow
    assert flow is not None
    assert flow.moving.sum() == 100
    assert frame > 3 * FRAMES // 4


def test_where_nothing_moves_it_is_the_middle():
    recording = moving_late()
    opened = fake_opened(recording)
    first = next(candidates(recording, 8))
    assert first_frame_with_flow(opened, Parameters(delta=0.5), Estimates()) == first
    assert first == pytest.approx(FRAMES / 2, abs=4)


def test_frames_that_cannot_be_read_are_passed_over():
    recording = fake_recording()
    cloud = recording.cloud

    def broken_in_the_middle(k, max_range=4.0):
        if k == 24:
            raise RuntimeError("broken")
        return cloud(k, max_range)

    recording.cloud = broken_in_the_middle
    assert first_frame_with_flow(fake_opened(recording), Parameters(), Estimates()) not in (
        24,
        24 + 8,
    )


@pytest.mark.parametrize("length", [1, 2, 9])
def test_short_recordings_have_a_frame(length):
    recording = fake_recording()
    short = type("Short", (type(recording),), {"__len__": lambda self: length})
    recording.__class__ = short
    assert 0 <= first_frame_with_flow(fake_opened(recording), Parameters(), Estimates()) < length


def test_of_a_long_recording_few_frames_are_asked_for_their_truth(long):
    recording = fake_recording(frames=30_000)
    recording.truth = lambda k: SPEED if (k // 100) % 3 == 1 else np.zeros(3)
    frames = asked(recording)
    first = first_frame_with_flow(fake_opened(recording), Parameters(), Estimates())
    assert (first // 100) % 3 == ((first - 8) // 100) % 3 == 1
    assert first == pytest.approx(15_000, abs=3000)
    assert 2 <= len(frames) < 20
    frames.clear()
    found = [*candidates(recording, 8)]
    assert 1 < len(found) <= 9
    assert all((k // 100) % 3 == ((k - 8) // 100) % 3 == 1 for k in found)
    assert len(frames) <= 2 * 66


def test_a_long_recording_in_which_nothing_moves_is_opened_in_its_middle(long):
    recording = fake_recording(frames=30_000)
    recording.truth = lambda k: np.zeros(3)
    frames = asked(recording)
    found = [*candidates(recording, 8)]
    assert len(frames) <= 2 * 66
    assert found[0] == pytest.approx(15_000, abs=8)
    assert len(found) == 9


@pytest.mark.parametrize("length", [1, 2, 9, 40])
@pytest.mark.parametrize("truth", [None, np.zeros(3), SPEED])
def test_a_long_recording_may_have_few_frames_or_no_truth(long, length, truth):
    recording = fake_recording(frames=length)
    recording.truth = lambda k: truth
    found = [*candidates(recording, 8)]
    assert 1 <= len(found) <= 9
    assert len({*found}) == len(found)
    assert all(0 <= k < length for k in found)
