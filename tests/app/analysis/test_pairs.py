"""Pairs: frames, interval, truth and window, against a recording of which every number is known."""

from dataclasses import replace

import numpy as np
import pytest

from app.analysis.pairs import Pair, prepare_pair
from estimator import Parameters, estimate
from recordings import PairTruth, RecordingError
from tests.app.fake_recordings import PERIOD, SPEED, fake_recording

PARAMETERS = Parameters(n=5)


def test_a_pair_is_made_of_frames_k_minus_n_and_k():
    recording = fake_recording()
    pair = prepare_pair(recording, 20, PARAMETERS).pair
    assert pair.source is not None
    np.testing.assert_array_equal(pair.source.points, recording.cloud(15).points)
    np.testing.assert_array_equal(pair.target.points, recording.cloud(20).points)
    assert pair.interval == pytest.approx(5 * PERIOD)
    assert (pair.frame, pair.n, pair.flow) == (20, 5, None)


def test_its_window_has_the_frames_between_which_are_read_when_they_are_looked_at():
    recording = fake_recording()
    read: list[int] = []
    cloud = recording.cloud

    def noted(k: int, max_range: float = 4.0):
        read.append(k)
        return cloud(k, max_range)

    recording.cloud = noted
    window = prepare_pair(recording, 20, PARAMETERS).window
    assert window is not None
    assert sorted(read) == [15, 20]
    np.testing.assert_allclose(window.stamps, recording.stamps[15:21])
    for index, frame in enumerate(window.frames):
        np.testing.assert_array_equal(frame.points, cloud(15 + index).points)
    assert sorted(read) == [15, 16, 17, 18, 19, 20]


def test_before_frame_n_there_is_a_target_alone():
    prepared = prepare_pair(fake_recording(), 4, PARAMETERS)
    assert prepared.window is prepared.pair.source is prepared.pair.truth is None
    assert np.isnan(prepared.pair.interval)
    assert not len(prepared.pair.truly_moving)
    assert prepared.pair.pooled_errors() is None


def test_a_frame_that_cannot_be_read_is_said():
    recording = fake_recording()

    def broken(k: int, max_range: float = 4.0):
        raise RecordingError(f"frame {k} is broken")

    recording.cloud = broken
    with pytest.raises(RecordingError, match="frame 20 is broken"):
        prepare_pair(recording, 20, PARAMETERS)


def with_flow(truth: PairTruth | None) -> Pair:
    """Pair of frame 20 with this truth, estimated."""
    recording = fake_recording()
    recording.pair_truth = lambda *_: truth
    prepared = prepare_pair(recording, 20, PARAMETERS)
    assert prepared.window is not None
    return replace(prepared.pair, flow=estimate(prepared.window, PARAMETERS))


def test_errors_are_of_the_points_that_truly_move():
    size, patch = 500, slice(400, 500)
    points = np.zeros((size, 3))
    points[patch] = SPEED
    pair = with_flow(PairTruth(np.broadcast_to(SPEED, (size, 3)), points))
    assert pair.truly_moving.sum() == 100
    assert pair.truly_moving[patch].all()
    assert pair.object_velocity == pytest.approx(SPEED)
    assert pair.anything_moves
    assert pair.errors is not None
    assert pair.errors.velocity_error == pytest.approx(0.0, abs=1e-6)
    assert (pair.errors.coverage, pair.errors.precision) == (1.0, 1.0)


def test_of_an_object_that_rests_there_are_no_errors_but_false_flow():
    pair = with_flow(PairTruth(np.zeros((500, 3)), np.zeros((500, 3))))
    assert pair.object_velocity is pair.errors is None
    pooled = pair.pooled_errors(counts=False)
    assert pooled is not None
    # The patch moves and its truth says that it rests.
    assert pooled.metrics().false_flow == pytest.approx(100 / 500)


def test_without_truth_there_are_no_errors():
    pair = with_flow(None)
    assert pair.errors is pair.pooled_errors() is pair.pooled_errors(counts=False) is None
    assert pair.anything_moves
