"""Views from a sensor, and sensors under a ray."""

from typing import Any, cast

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from app.scene.sensor_view import sensor_at, view_from
from recordings import RecordedSensor
from robot_assets import SensorModel

EYE = RecordedSensor("eye", "", "eye", SensorModel().directions, cast(Any, None), (0.0, 4.0))
# Looks along x, its image's top up.
LEVEL = np.array([[0, 0, 1], [-1, 0, 0], [0, -1, 0]], dtype=float)


def pose(R, t=(0.0, 0.0, 0.0)):
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, t
    return T


def test_the_camera_looks_along_the_optical_axis_with_up_as_in_the_image():
    camera, up = view_from(EYE, pose(LEVEL, (1.0, 2.0, 3.0)), 0.8, np.eye(3), 1.5)
    assert np.linalg.norm(np.subtract(camera.position, (1.0, 2.0, 3.0))) < 0.02
    along = np.subtract(camera.look_at, camera.position)
    np.testing.assert_allclose(along, [0.8, 0.0, 0.0], atol=1e-12)
    np.testing.assert_allclose(up, [0.0, 0.0, 1.0], atol=1e-12)


@pytest.mark.parametrize("turn", [90, 180])
def test_a_sensor_that_is_mounted_turned_shows_a_turned_scene(turn):
    R = LEVEL @ Rotation.from_euler("z", turn, degrees=True).as_matrix()
    _, up = view_from(EYE, pose(R), np.nan, np.eye(3), 1.5)
    # Turned clockwise as it looks, its up goes from z over its right, -y, to -z.
    expected = {90: [0.0, -1.0, 0.0], 180: [0.0, 0.0, -1.0]}[turn]
    np.testing.assert_allclose(up, expected, atol=1e-12)


def test_the_field_of_view_fits_into_narrow_and_wide_pictures():
    for aspect in (0.5, 2.0):
        camera, _ = view_from(EYE, pose(LEVEL), 1.0, np.eye(3), aspect)
        height = np.tan(camera.fov / 2)
        assert min(height, aspect * height) > np.tan(np.pi / 8)


def test_a_ray_hits_the_nearest_frustum_and_none_from_inside():
    poses = np.stack([pose(LEVEL), pose(LEVEL, (0.0, 0.5, 0.0)), np.full((4, 4), np.nan)])
    sensors = (EYE, EYE, EYE)
    across = np.array([0.0, -1.0, 0.0])
    for start, found in ((2.0, 1), (0.3, 0)):
        assert sensor_at(sensors, poses, np.array([0.08, start, 0.0]), across) == found
    assert sensor_at(sensors, poses, np.array([0.08, -1.0, 0.0]), across) is None
    assert sensor_at(sensors, poses, np.array([0.2, 2.0, 0.0]), across) is None
    inside, ahead = np.array([0.05, 0.0, 0.0]), np.array([1.0, 0.0, 0.0])
    assert sensor_at(sensors, poses, inside, ahead) is None
