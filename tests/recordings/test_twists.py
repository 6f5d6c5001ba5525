import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from recordings.twists import Twist, fitted_twist

POINTS = np.random.default_rng(0).uniform(-0.3, 0.3, (40, 3)) + np.array([0.2, 0.8, 0.4])
numbers = st.lists(st.floats(-2, 2), min_size=3, max_size=3).map(np.array)


@given(numbers, numbers)
def test_a_rigid_motion_is_found_again(turn: np.ndarray, shift: np.ndarray):
    true = Twist(turn, shift)
    found = fitted_twist(POINTS, true.velocity(POINTS))
    assert found.angular == pytest.approx(turn, abs=1e-9)
    assert found.linear == pytest.approx(shift, abs=1e-9)


def test_following_a_turn_is_a_rotation():
    axis = np.array([0.2, 0.7, 0.0])
    turn = np.array([0.0, 0.0, 0.9])
    motion = Twist(turn, -np.cross(turn, axis)).motion(1.5)
    R = Rotation.from_rotvec(1.5 * turn).as_matrix()
    assert motion[:3, :3] == pytest.approx(R)
    assert motion[:3, 3] == pytest.approx(axis - R @ axis)


@pytest.mark.parametrize("count", [1, 2, 5])
def test_few_points_tell_their_mean_velocity_and_no_turn(count: int):
    velocity = np.random.default_rng(1).normal(size=(count, 3))
    found = fitted_twist(POINTS[:count], velocity)
    assert not found.angular.any()
    assert found.linear == pytest.approx(velocity.mean(axis=0))


def test_points_in_a_line_do_not_tell_the_turn_about_it():
    line = np.outer(np.linspace(0.0, 1.0, 20), [0.0, 0.0, 1.0]) + np.array([0.2, 0.5, 0.0])
    noise = 1e-3 * np.random.default_rng(2).normal(size=line.shape)
    true = Twist(np.array([0.4, 0.0, 0.0]), np.zeros(3))
    found = fitted_twist(line, true.velocity(line) + noise)
    assert found.angular[0] == pytest.approx(0.4, abs=0.01)
    assert found.angular[2] == pytest.approx(0.0, abs=1e-12)


def test_numbers_that_are_none_are_left_out():
    velocity = np.tile([0.1, 0.0, 0.0], (40, 1))
    velocity[3] = np.nan
    assert fitted_twist(POINTS, velocity).linear == pytest.approx([0.1, 0.0, 0.0])
    assert not fitted_twist(POINTS, np.full((40, 3), np.nan)).linear.any()
