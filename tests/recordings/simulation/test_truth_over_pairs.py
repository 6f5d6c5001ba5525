from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest

from recordings import open_recording
from tests.recordings.simulation.made import COARSE, written


@pytest.fixture(scope="module")
def turning(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return written(tmp_path_factory.mktemp("turning") / "x.mcap", "turning")


def test_what_turns_is_followed_exactly_over_a_pair(turning: Path):
    check_turn(turning)


def test_what_turns_is_followed_exactly_in_spite_of_imperfections(tmp_path: Path):
    imperfections = ("ramps", "dropped_frames", "stamp_jitter")
    check_turn(written(tmp_path / "x.mcap", "turning", imperfections=imperfections))


def check_turn(path: Path) -> None:
    with open_recording(path) as recording:
        k = len(recording) // 2
        truth = recording.pair_truth(k - 8, k)
        cloud, velocity = recording.cloud(k - 8), recording.point_truth(k - 8)
        assert truth is not None
        assert truth.points is not None
        assert velocity is not None
        moving = np.linalg.norm(velocity, axis=1) > 0
        assert moving.sum() > 50
        interval = recording.stamps[k] - recording.stamps[k - 8]
        # At the axis nothing moves: the hand is 0.5 m from it and has the speed.
        rate = 0.30 / 0.5
        axis = np.array([0.0, 0.75]) + _start_offset("turning", 0.30)
        arms = cloud.points[moving, :2] - axis
        # The middle of a pair is at full speed, with ramps, too.
        angle = rate * interval
        turned = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        exact = (arms @ turned.T - arms) / interval
        assert truth.points[moving, :2] == pytest.approx(exact, abs=2e-3)
        assert truth.points[moving, 2] == pytest.approx(0.0, abs=1e-6)
        assert not truth.points[~moving].any()
        # The paper's errors compare every point with what turns.
        assert np.isfinite(truth.velocity).all()
        assert truth.velocity[moving] == pytest.approx(truth.points[moving], abs=2e-3)
        arms = cloud.points[~moving, :2] - axis
        exact = (arms @ turned.T - arms) / interval
        assert truth.velocity[~moving, :2] == pytest.approx(exact, abs=5e-3)
        target = recording.truth(k)
        assert target is not None
        assert np.linalg.norm(target) == pytest.approx(0.30, abs=1e-6)


def _start_offset(name: str, speed: float) -> np.ndarray:
    key = [0, 1, round(speed * 1e6), *name.encode()]
    return np.random.default_rng(key).uniform(-0.015, 0.015, 3)[:2]


def test_of_two_that_cross_one_is_the_target_and_each_point_has_its_own_truth(
    tmp_path: Path,
):
    path = written(tmp_path / "x.mcap", "crossing")
    with open_recording(path) as recording:
        k = len(recording) // 2 - 6
        truth, velocity = recording.pair_truth(k - 8, k), recording.point_truth(k - 8)
        assert truth is not None
        assert truth.points is not None
        assert velocity is not None
        forth, back = velocity[:, 0] > 0.1, velocity[:, 0] < -0.1
        assert forth.sum() > 30
        assert back.sum() > 10
        everywhere = np.tile([0.5, 0.0, 0.0], (len(velocity), 1))
        assert truth.velocity == pytest.approx(everywhere, abs=1e-5)
        for mine, speed in ((forth, 0.5), (back, -0.5), (~forth & ~back, 0.0)):
            assert truth.points[mine] == pytest.approx(
                np.tile([speed, 0.0, 0.0], (mine.sum(), 1)), abs=1e-5
            )
        assert recording.truth(k) == pytest.approx([0.5, 0.0, 0.0])


def test_limbs_of_a_person_swing_and_the_target_is_the_torso(tmp_path: Path):
    path = written(tmp_path / "x.mcap", "walking", speed=0.5)
    with open_recording(path) as recording:
        k = len(recording) - 16
        velocity = recording.point_truth(k)
        assert recording.truth(k) == pytest.approx([0.0, -0.5, 0.0])
        assert velocity is not None
        moving = velocity[np.linalg.norm(velocity, axis=1) > 0]
        assert len(moving) > 60
        torso = np.abs(moving - [0.0, -0.5, 0.0]).max(axis=1) < 1e-6
        assert 20 < torso.sum() < len(moving) - 20
        assert np.abs(moving[~torso, 0]).max() < 1e-6
        assert np.ptp(moving[:, 1]) > 0.1


@pytest.mark.parametrize("name", ["still", "still_robot_moving"])
def test_where_nothing_moves_nothing_truly_moves(tmp_path: Path, name: str):
    path = written(tmp_path / "x.mcap", name, rig=COARSE)
    with open_recording(path) as recording:
        assert recording.provenance is not None
        assert recording.provenance.speed == 0.0
        moves = recording.joint_positions(0) != recording.joint_positions(len(recording) - 1)
        assert moves == (name == "still_robot_moving")
        for k in range(8, len(recording), 5):
            truth = recording.pair_truth(k - 8, k)
            assert truth is not None
            assert truth.points is not None
            assert not truth.points.any()
            assert not truth.velocity.any()


def test_where_nothing_moves_there_is_no_speed(tmp_path: Path):
    with pytest.raises(ValueError, match="In still nothing moves; its speed is 0"):
        written(tmp_path / "x.mcap", "still", speed=0.2)


def test_without_poses_a_turn_is_found_from_the_velocities(turning: Path):
    with open_recording(turning) as recording:
        own = recording._parts.point_truths
        assert own is not None
        k = len(recording) // 2
        cloud = recording.cloud(k - 8)
        by_poses = own.over(k - 8, k, cloud)
        own._poses = lru_cache(lambda number: None)
        by_velocities = own.over(k - 8, k, cloud)
        assert by_poses is not None
        assert by_velocities is not None
        start = recording.point_truth(k - 8)
        assert start is not None
        # Half a radian a second for half a second changes velocities by an eighth.
        assert np.abs(by_poses - start).max() > 0.02
        assert by_velocities == pytest.approx(by_poses, abs=1e-5)
