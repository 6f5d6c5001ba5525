import numpy as np
import pytest

from app.exports.key_views import camera_between, key_times
from app.exports.pinhole import Pinhole, filling
from app.scene.camera import Camera

CAMERA = Camera((5.0, -6.0, 4.0), (3.0, 0.0, 1.0), 0.66)


def test_the_look_at_point_is_in_the_middle_and_up_is_up():
    places, depth = Pinhole(CAMERA, 160, 90).project(np.array([CAMERA.look_at, [3.0, 0.0, 1.1]]))
    np.testing.assert_allclose(places[0], [80, 45], atol=1e-9)
    assert depth[0] == pytest.approx(np.linalg.norm([2, 6, 3]))
    assert places[1, 0] == pytest.approx(80)
    assert places[1, 1] < 45


def test_the_field_of_view_is_the_pictures_height():
    ahead = Camera((0.0, 0.0, 0.0), (2.0, 0.0, 0.0), 2 * np.arctan(0.5))
    places, _ = Pinhole(ahead, 200, 100).project(np.array([[2.0, 0.0, 1.0], [2.0, -2.0, 0.0]]))
    np.testing.assert_allclose(places, [[100, 0], [200, 50]], atol=1e-9)


def test_what_is_behind_the_camera_has_no_place():
    behind = 2 * np.array(CAMERA.position) - np.array(CAMERA.look_at)
    places, depth = Pinhole(CAMERA, 160, 90).project(behind[None])
    assert np.isnan(places).all()
    assert depth[0] < 0


@pytest.mark.parametrize("aspect", [0.4, 1.0, 2.5])
@pytest.mark.parametrize("free", [0.0, 0.2])
def test_points_just_fill_the_picture(aspect, free):
    rng = np.random.default_rng(0)
    points = rng.uniform(-1, 1, (200, 3)) * [2, 1, 0.5] + [3, 0, 1]
    moved = filling(CAMERA, aspect, points, free)
    places, depth = Pinhole(moved, 100 * aspect, 100).project(points)
    assert (depth > 0).all()
    low, high = places.min(axis=0), places.max(axis=0)
    edges = [*(low / [100 * aspect, 100]), *(1 - high / [100 * aspect, 100])]
    assert min(edges) > 0.069
    assert edges[3] >= max(free, 0.07) - 1e-9
    full = abs(edges[0] - 0.07) + abs(edges[2] - 0.07) < 1e-6
    full |= abs(edges[1] - 0.07) + abs(edges[3] - max(free, 0.07)) < 1e-6
    assert full, "it could be nearer"
    before, after = (np.subtract(c.look_at, c.position) for c in (CAMERA, moved))
    np.testing.assert_allclose(
        before / np.linalg.norm(before), after / np.linalg.norm(after), atol=1e-9
    )


def test_without_points_the_camera_stays():
    assert filling(CAMERA, 1.5, np.zeros((0, 3))) is CAMERA


def test_a_camera_moves_from_key_to_key_upright_and_the_shorter_way():
    above = Camera((3.0, -1e-3, 7.0), (3.0, 0.0, 1.0), 0.66)
    keys = [CAMERA, above, CAMERA]
    for part, key in ((0.0, CAMERA), (0.5, above), (1.0, CAMERA)):
        found = camera_between(keys, part)
        np.testing.assert_allclose(found.position, key.position, atol=1e-9)
        np.testing.assert_allclose(found.look_at, key.look_at, atol=1e-9)
    away = [
        np.subtract(camera.position, camera.look_at)
        for camera in (camera_between(keys, part) for part in np.linspace(0, 0.5, 20))
    ]
    assert (np.diff([ray[2] / np.linalg.norm(ray) for ray in away]) > 0).all(), "it does not rise"
    assert camera_between([CAMERA], 0.7) is CAMERA
    assert key_times(1) == [0.0]
    assert key_times(5) == [0.0, 0.25, 0.5, 0.75, 1.0]
