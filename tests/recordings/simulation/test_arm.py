import numpy as np
import pytest
import trimesh

from recordings.simulation.arm import Arm
from recordings.simulation.inverse_kinematics import FLANGE, UnreachableError
from recordings.simulation.trajectory import REST, Trajectory
from robot_assets import load_robot
from tests.recordings.simulation.test_inverse_kinematics import READY

ROBOT = load_robot()
PLACE = trimesh.transformations.rotation_matrix(np.pi / 2, (0, 0, 1), (0.4, 0.1, 0.0))
TRAJECTORY = Trajectory(np.array([[0.1, 0.05, 0.0], [0.04, 0.02, 0.0]]), 0.25)
TIMES = np.linspace(REST + 0.01, TRAJECTORY.end - 0.01, 7)


@pytest.fixture(scope="module")
def arm() -> Arm:
    return Arm(ROBOT, PLACE, READY, TRAJECTORY)


def test_the_flange_follows_the_trajectory_without_turning(arm: Arm):
    start = arm.link_poses(0.0)[FLANGE]
    assert start == pytest.approx(PLACE @ ROBOT.link_poses(READY)[FLANGE])
    for time in [0.2, *TIMES, 60.0]:
        flange = arm.link_poses(time)[FLANGE]
        gone = TRAJECTORY.displacement(TRAJECTORY.travelled(time))
        assert flange[:3, 3] - start[:3, 3] == pytest.approx(gone, abs=2e-5)
        assert flange[:3, :3] == pytest.approx(start[:3, :3], abs=1e-4)


def test_rates_are_the_derivatives_of_the_poses(arm: Arm):
    step = 1e-3
    for time in TIMES:
        rates = arm.link_rates(time)
        before, after = arm.link_poses(time - step), arm.link_poses(time + step)
        for link, rate in rates.items():
            assert rate == pytest.approx((after[link] - before[link]) / (2 * step), abs=1e-4), link
        assert rates[FLANGE][:3, 3] == pytest.approx(TRAJECTORY.velocity(time), abs=1e-3)
        assert np.abs(rates["panda_link4"][:3]).max() > 0.01


def test_at_rest_nothing_has_a_rate(arm: Arm):
    for time in (0.0, REST - 0.01, TRAJECTORY.end + 0.01):
        assert all(not rate.any() for rate in arm.link_rates(time).values())


def test_without_a_trajectory_it_keeps_its_posture():
    still = Arm(ROBOT, np.eye(4), READY, None)
    assert still.end == 0.0
    assert still.joint_positions(1.3) == READY
    assert all(not rate.any() for rate in still.link_rates(1.3).values())


def test_a_trajectory_that_leaves_the_reach_is_an_error():
    with pytest.raises(UnreachableError):
        Arm(ROBOT, np.eye(4), READY, Trajectory(np.array([[1.0, 0.0, 0.0]]), 0.2))
