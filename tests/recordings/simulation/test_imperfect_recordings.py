from pathlib import Path

import numpy as np
import pytest

from recordings import Frame, open_recording
from recordings.simulation import SCENARIOS
from tests.recordings.simulation.made import COARSE, RIG, frames, written


def test_lost_frames_are_missing_and_the_others_are_the_same():
    def made(imperfections: tuple[str, ...]) -> dict[float, Frame]:
        simulated = frames(
            SCENARIOS["towards"], 0.6, noise="measured", imperfections=imperfections, rig=COARSE
        )
        return {frame.stamp: frame for frame in simulated}

    all_of_them, rest = made(()), made(("dropped_frames",))
    assert set(rest) < set(all_of_them)
    assert 0.85 < len(rest) / len(all_of_them) < 1.0
    for stamp, frame in rest.items():
        assert np.array_equal(frame.ranges, all_of_them[stamp].ranges, equal_nan=True)


def test_stamps_that_are_wrong_leave_the_readings_and_all_else_is_as_the_stamp_says():
    simulated = list(frames(SCENARIOS["towards"], imperfections=("stamp_jitter",), rig=COARSE))
    stamps = np.array([frame.stamp for frame in simulated])
    off = stamps - (1.0 + np.arange(len(stamps)) / 15)
    assert 0.002 < off.std() < 0.006
    assert np.abs(off).max() <= 0.015
    moving = [frame for frame in simulated if frame.target_velocity.any()]
    gone = [frame.T_base_target[1, 3] - simulated[0].T_base_target[1, 3] for frame in moving]
    assert gone == pytest.approx([-0.6 * (frame.stamp - 1.7) for frame in moving])
    right = list(frames(SCENARIOS["towards"], rig=COARSE))
    assert len(right) == len(simulated)
    for frame, same in zip(simulated, right, strict=True):
        assert np.array_equal(frame.ranges, same.ranges, equal_nan=True)


def test_the_reader_drops_what_the_status_says_is_no_distance(tmp_path: Path):
    path = written(tmp_path / "x.mcap", "towards", speed=1.0, noise="measured")
    made = list(frames(SCENARIOS["towards"], 1.0, noise="measured"))
    with open_recording(path) as recording:
        assert recording.warnings == ()
        where = [[s.name for s in RIG.sensors].index(s.name) for s in recording.sensors]
        for k in (0, len(recording) // 2):
            frame, ranges = made[k], recording.cloud(k).ranges
            assert frame.status is not None
            reported, valid = np.isfinite(frame.ranges), frame.status == 5
            assert (reported & ~valid).sum() > 100
            assert np.array_equal(np.isfinite(ranges), (reported & valid)[where])
            assert len(frame.truth.points) == (reported & valid).sum()
            kept = np.isfinite(ranges)
            assert ranges[kept] == pytest.approx(frame.ranges[where][kept], abs=6e-4)
