import numpy as np
import pytest

from recordings.tracks import vector_track
from recordings.truth import RigidTruth, TurningTruth, TwistTruth
from tests.recordings.foreign import at

S = 1_000_000_000
STAMPS = np.arange(5) * S


def test_a_twist_is_the_velocity_of_every_point():
    track = vector_track(STAMPS, np.outer([0, 1, 2, 3, 4], [1.0, 0, 0]))
    assert track is not None
    truth = TwistTruth(track, STAMPS)
    at_2, over = truth.at(2), truth.over(1, 3, np.zeros((7, 3)))
    assert at_2 is not None
    assert over is not None
    np.testing.assert_allclose(at_2, [2, 0, 0])
    np.testing.assert_allclose(over, np.tile([2.0, 0, 0], (7, 1)))


def test_a_rigid_motion_carries_each_point():
    truth = RigidTruth(np.stack([at(turn=0.1 * k) for k in range(5)]), STAMPS)
    points = np.array([[1.0, 0, 0], [0.0, 0, 5.0]])
    over = truth.over(0, 2, points)
    assert over is not None
    turned = np.array([np.cos(0.2) - 1, np.sin(0.2), 0]) / 2
    np.testing.assert_allclose(over, np.stack([turned, np.zeros(3)]), atol=1e-12)


def test_the_velocity_of_a_frame_is_that_of_its_origin():
    truth = RigidTruth(np.stack([at(x=0.5 * k * k) for k in range(5)]), STAMPS)
    velocity = truth.at(2)
    assert velocity is not None
    assert velocity[0] == pytest.approx(2.0)


def test_the_truth_is_unknown_where_the_pose_is():
    poses = np.stack([at(x=float(k)) for k in range(5)])
    poses[2] = np.nan
    truth = RigidTruth(poses, STAMPS)
    assert truth.at(1) is None
    assert truth.over(0, 2, np.zeros((1, 3))) is None
    assert truth.over(0, 4, np.zeros((1, 3))) is not None


def test_what_turns_has_the_recorded_velocity_and_carries_points_by_its_pose():
    track = vector_track(STAMPS, np.tile([0.3, 0, 0], (5, 1)))
    assert track is not None
    poses = np.stack([at(turn=0.1 * k) for k in range(5)])
    poses[3] = np.nan
    twist, rigid = TwistTruth(track, STAMPS), RigidTruth(poses, STAMPS)
    truth, points = TurningTruth(twist, rigid), np.array([[1.0, 0, 0], [0.0, 0, 5.0]])
    at_2, over = truth.at(2), truth.over(0, 2, points)
    carried, blind = rigid.over(0, 2, points), truth.over(0, 3, points)
    assert at_2 is not None
    assert over is not None
    assert carried is not None
    assert blind is not None
    np.testing.assert_allclose(at_2, [0.3, 0, 0])
    np.testing.assert_allclose(over, carried)
    # Where the pose is unknown, its velocity is all that is known.
    np.testing.assert_allclose(blind, [[0.3, 0, 0]] * 2)
