import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.scene.first_view import first_view
from app.scene.scene_root import upright

FOV = np.radians(50)
ASPECT = 1.3


def looking(position, forward):
    pose = np.eye(4)
    forward = np.asarray(forward) / np.linalg.norm(forward)
    side = np.cross([0.0, 0.0, 1.0], forward)
    pose[:3, :3] = np.stack([side, np.cross(forward, side), forward], axis=1)
    pose[:3, 3] = position
    return pose


def visible(view, points, aspect=ASPECT):
    """Whether points lie inside the picture of a camera with z up."""
    forward = view.look_at - view.position
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    rays = points - view.position
    depth = rays @ forward
    high = np.abs(rays @ np.cross(right, forward)) <= depth * np.tan(FOV / 2)
    return high & (np.abs(rays @ right) <= depth * np.tan(FOV / 2) * aspect)


def test_a_single_sensor_and_its_points_are_in_the_picture():
    wall = np.random.default_rng(0).uniform([0.8, -0.4, -0.4], [0.9, 0.4, 0.4], (60, 3))
    view = first_view(wall, looking([0, 0, 0], [1, 0, 0])[None], np.eye(3), FOV, ASPECT)
    assert visible(view, np.zeros((1, 3))).all()
    assert visible(view, wall).mean() > 0.9


def test_far_walls_do_not_push_the_camera_away():
    rng = np.random.default_rng(0)
    near = rng.uniform(-0.5, 0.5, (300, 3))
    far = near * 8
    poses = np.stack([looking([0.1, 0, 0], [1, 0, 0]), looking([-0.1, 0, 0], [-1, 0, 0])])
    alone = first_view(near, poses, np.eye(3), FOV, ASPECT)
    both = first_view(np.vstack([near, far]), poses, np.eye(3), FOV, ASPECT)
    assert np.linalg.norm(both.position) < 1.3 * np.linalg.norm(alone.position)


def test_nothing_known_still_gives_a_view():
    view = first_view(np.zeros((0, 3)), np.full((3, 4, 4), np.nan), np.eye(3), FOV, ASPECT)
    assert np.isfinite(view.position).all()
    assert np.linalg.norm(view.position - view.look_at) > 0.1


@given(st.integers(0, 2**32 - 1))
def test_the_camera_is_above_what_it_looks_at(seed):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(50, 3))
    pose = looking(rng.normal(size=3), [*rng.normal(size=2), 0.1])
    view = first_view(points, pose[None], np.eye(3), FOV, ASPECT)
    assert view.position[2] > view.look_at[2]


def test_an_optical_frame_is_drawn_with_its_y_axis_down():
    R = upright("tof_front_optical_frame")
    np.testing.assert_allclose(R @ R.T, np.eye(3))
    assert np.linalg.det(R) == pytest.approx(1)
    np.testing.assert_allclose(R @ [0, 1, 0], [0, 0, -1])
    np.testing.assert_allclose(upright("world"), np.eye(3))


def test_what_moves_is_in_the_picture_however_far_it_is():
    rng = np.random.default_rng(0)
    near = rng.uniform(-0.5, 0.5, (300, 3))
    moving = np.array([0.0, 2.0, 0.5]) + rng.uniform(-0.1, 0.1, (50, 3))
    points = np.vstack([near, moving])
    poses = np.stack([looking([0.1, 0, 0], [1, 0, 0]), looking([-0.1, 0, 0], [-1, 0, 0])])
    assert visible(first_view(points, poses, np.eye(3), FOV, ASPECT, moving), moving).all()


def test_a_single_sensor_is_seen_with_what_it_looks_at_far_away():
    wall = np.random.default_rng(0).uniform([2.5, -1, -1], [2.6, 1, 1], (60, 3))
    close = np.random.default_rng(0).uniform([0.4, -0.1, -0.1], [0.5, 0.1, 0.1], (20, 3))
    points = np.vstack([wall, close])
    view = first_view(points, looking([0, 0, 0], [1, 0, 0])[None], np.eye(3), FOV, ASPECT)
    assert visible(view, points).mean() > 0.8
