import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from recordings.simulation.motion import Motion, Swing, Translation, Turn
from recordings.simulation.trajectory import REST, Trajectory

PATH = Trajectory(np.array([[0.0, -1.0, 0.0]]), 0.5, ramp=0.25)
WALK = Translation(np.array([0.1, 1.7, 0.4]), PATH)
TURN = Turn(np.array([0.2, 0.7, 0.4]), np.array([0.5, 0.1, -0.3]), -0.8, PATH)
SWING = Swing(WALK, np.array([0.2, 0.0, 0.16]), 0.3, 0.5)


@pytest.mark.parametrize("motion", [WALK, TURN, SWING])
@given(share=st.floats(0.01, 0.99))
def test_the_rate_is_the_derivative_of_the_pose(motion: Motion, share: float):
    time, step = REST + share * (motion.end - REST), 1e-6
    derivative = (motion.pose(time + step) - motion.pose(time - step)) / (2 * step)
    assert motion.rate(time) == pytest.approx(derivative, abs=2e-5)
    assert motion.pose(time)[:3, :3] @ motion.pose(time)[:3, :3].T == pytest.approx(np.eye(3))


@pytest.mark.parametrize("motion", [WALK, TURN, SWING])
def test_before_and_after_there_is_rest(motion: Motion):
    for time in (0.0, REST, motion.end + 0.01, 9.0):
        assert not motion.rate(time).any()


def test_the_origin_of_what_turns_goes_along_a_circle_at_the_speed():
    radius = np.hypot(0.5, 0.1)
    for time in np.linspace(REST + 0.3, TURN.end - 0.3, 5):
        assert np.linalg.norm(TURN.rate(time)[:3, 3]) == pytest.approx(0.5)
        from_axis = TURN.pose(time)[:3, 3] - TURN.centre
        assert np.hypot(*from_axis[:2]) == pytest.approx(radius)
    turned = TURN.pose(0.0)[:3, :3].T @ TURN.pose(9.0)[:3, :3]
    assert np.arctan2(turned[1, 0], turned[0, 0]) == pytest.approx(1.0 / radius)


def test_a_limb_swings_about_its_joint_and_hangs_straight_at_every_step():
    joint = np.append(SWING.joint, 1.0)
    angles = []
    for time in np.linspace(0.0, SWING.end, 301):
        pose = SWING.pose(time)
        assert pose @ joint == pytest.approx(WALK.pose(time) @ joint)
        angles.append(np.arctan2(pose[2, 1], pose[1, 1]))
    assert (max(angles), min(angles)) == pytest.approx((0.3, -0.3), abs=1e-3)
    assert (angles[0], angles[-1]) == pytest.approx((0.0, 0.0), abs=1e-9)
    half_way = REST + (SWING.end - REST) / 2
    assert SWING.pose(half_way) == pytest.approx(WALK.pose(half_way), abs=1e-9)
