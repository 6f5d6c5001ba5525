import warnings

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from recordings.tracks import pose_track, vector_track
from tests.fuzz.making import SIGNALLING_NAN

S = 1_000_000_000
EPOCH = 1_700_000_000 * S


def test_a_pose_is_linear_in_place_and_spherical_in_turn():
    turns = Rotation.from_euler("z", [[0.0], [1.0]]).as_quat()
    track = pose_track(np.array([EPOCH, EPOCH + S]), np.array([[0.0, 0, 0], [2.0, 0, 4.0]]), turns)
    assert track is not None
    T = track.at(np.array([EPOCH + S // 4]))[0]
    np.testing.assert_allclose(T[:3, 3], [0.5, 0, 1.0], atol=1e-9)
    np.testing.assert_allclose(Rotation.from_matrix(T[:3, :3]).as_euler("xyz"), [0, 0, 0.25])


def test_a_pose_is_known_from_its_first_to_its_last_sample_only():
    track = pose_track(np.array([10, 20]), np.zeros((2, 3)), np.tile([0, 0, 0, 1.0], (2, 1)))
    assert track is not None
    poses = track.at(np.array([9, 10, 15, 20, 21]))
    assert np.isfinite(poses).all(axis=(1, 2)).tolist() == [False, True, True, True, False]


def test_poses_may_come_in_any_order_and_the_last_of_equal_stamps_counts():
    track = pose_track(
        np.array([20, 10, 20]),
        np.array([[9.0, 0, 0], [0.0, 0, 0], [1.0, 0, 0]]),
        np.tile([0, 0, 0, 2.0], (3, 1)),
    )
    assert track is not None
    assert track.at(np.array([15]))[0, 0, 3] == pytest.approx(0.5)


def test_poses_that_are_none_are_left_out():
    assert pose_track(np.array([1]), np.zeros((1, 3)), np.zeros((1, 4))) is None
    assert pose_track(np.array([1]), np.full((1, 3), np.nan), np.ones((1, 4))) is None
    for number in (np.nan, SIGNALLING_NAN, np.inf, 1e300):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            assert pose_track(np.array([1]), np.zeros((1, 3)), np.full((1, 4), number)) is None


def test_a_velocity_holds_for_one_more_period_and_no_longer():
    track = vector_track(np.array([0, S, 2 * S]), np.array([[0.0], [1.0], [1.0]]))
    assert track is not None
    values = track.at(np.array([-2 * S, -S, S // 2, 3 * S, 3 * S + 1]))[:, 0]
    np.testing.assert_array_equal(values, [np.nan, 0.0, 0.5, 1.0, np.nan])


def test_the_mean_of_a_ramp_is_its_middle_and_of_a_corner_its_area():
    track = vector_track(np.array([0, S, 2 * S]), np.array([[0.0], [1.0], [1.0]]))
    assert track is not None
    assert track.mean(0, S)[0] == pytest.approx(0.5)
    assert track.mean(0, 2 * S)[0] == pytest.approx(0.75)
    assert track.mean(S // 2, 3 * S // 2)[0] == pytest.approx(0.875)


def test_after_a_stamp_of_zero_samples_a_few_nanoseconds_apart_are_one():
    stamps = np.array([0, EPOCH, EPOCH + 100, EPOCH + S])
    place = np.array([[0.0, 0, 0], [1.0, 0, 0], [1.0, 0, 0], [3.0, 0, 0]])
    poses = pose_track(stamps, place, np.tile([0, 0, 0, 1.0], (4, 1)))
    velocities = vector_track(stamps, place)
    assert poses is not None
    assert velocities is not None
    wanted = [*stamps[:3].tolist(), EPOCH + S // 2, EPOCH + S]
    found = [0.0, 1.0, 1.0, 2.0, 3.0]
    np.testing.assert_allclose(poses.at(np.array(wanted))[:, 0, 3], found, atol=1e-6)
    np.testing.assert_allclose(velocities.at(np.array(wanted))[:, 0], found, atol=1e-6)
