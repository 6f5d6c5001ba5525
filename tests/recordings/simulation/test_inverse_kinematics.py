import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from recordings.simulation.inverse_kinematics import (
    FLANGE,
    UnreachableError,
    inverse_kinematics,
)
from robot_assets import load_robot

ROBOT = load_robot()
READY = {
    "panda_joint1": 0.0,
    "panda_joint2": -0.785,
    "panda_joint3": 0.0,
    "panda_joint4": -2.356,
    "panda_joint5": 0.0,
    "panda_joint6": 1.571,
    "panda_joint7": 0.785,
    "panda_finger_joint1": 0.02,
}


@settings(max_examples=20)
@given(
    st.tuples(*[st.floats(-0.1, 0.1)] * 3),
    st.tuples(*[st.floats(-0.2, 0.2)] * 3),
)
def test_the_flange_gets_where_it_is_wanted(
    shift: tuple[float, float, float], turn: tuple[float, float, float]
):
    wanted = ROBOT.link_poses(READY)[FLANGE].copy()
    wanted[:3, 3] += shift
    wanted[:3, :3] = Rotation.from_rotvec(turn).as_matrix() @ wanted[:3, :3]
    found = inverse_kinematics(ROBOT, READY, wanted)
    assert ROBOT.link_poses(found)[FLANGE] == pytest.approx(wanted, abs=5e-6)
    assert ROBOT.outside_limits(found) == []
    assert found["panda_finger_joint1"] == 0.02


def test_where_it_is_already_nothing_moves():
    assert inverse_kinematics(ROBOT, READY, ROBOT.link_poses(READY)[FLANGE]) == READY


@pytest.mark.parametrize("place", [(2.0, 0.0, 0.5), (0.0, 0.0, 1.6)])
def test_a_pose_out_of_reach_is_an_error(place: tuple[float, float, float]):
    wanted = np.eye(4)
    wanted[:3, 3] = place
    with pytest.raises(UnreachableError):
        inverse_kinematics(ROBOT, READY, wanted)


def test_a_pose_beyond_a_joints_limit_is_an_error():
    wanted = ROBOT.link_poses(READY | {"panda_joint7": 2.7})[FLANGE].copy()
    wanted[:3, :3] = wanted[:3, :3] @ Rotation.from_rotvec([0, 0, 0.6]).as_matrix()
    with pytest.raises(UnreachableError, match="panda_joint7 is at 3"):
        inverse_kinematics(ROBOT, READY | {"panda_joint7": 2.7}, wanted)
