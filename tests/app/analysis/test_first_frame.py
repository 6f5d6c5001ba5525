import numpy as np
import pytest

from app.analysis.estimates import Estimates
from app.analysis.first_frame import candidates, first_frame_with_flow
from estimator import Parameters
from tests.app.fake_recordings import FRAMES, SPEED, fake_opened, fake_recording


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
    assert (
        first_frame_with_flow(opened, Parameters(delta=0.5), Estimates())
        == candidates(recording, 8)[0]
    )
    assert candidates(recording, 8)[0] == pytest.approx(FRAMES / 2, abs=4)


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
