"""Marks in the scene of what a person looks at."""

from typing import Any

import numpy as np
import pytest

from app.scene.pointer_view import POINTS_NODE, RAYS_NODE, SELECTED_NODE, Mark, PointerView
from app.scene.scene_root import FIXED
from tests.app.fake_recordings import fake_recording

RED, BLUE = (200, 0, 0), (0, 0, 200)


@pytest.fixture
def view(client) -> PointerView:
    client.scene.add_frame(FIXED, show_axes=False)
    return PointerView(client)


def mark(end: float, colour: Any, *, hit: bool = True) -> Mark:
    return Mark(np.zeros(3), np.array([end, 0.0, 0.0]), hit, colour)


def test_nothing_is_made_before_the_first_mark(client, view):
    view.mark([])
    assert client.scene.get_handle_by_name(RAYS_NODE) is None


def test_marks_are_rays_and_the_points_that_they_hit(client, view):
    view.mark([mark(1.0, RED), mark(4.0, BLUE, hit=False)])
    rays, points = client.node(RAYS_NODE), client.node(POINTS_NODE)
    np.testing.assert_array_equal(rays.points[:, 1, 0], [1.0, 4.0])
    np.testing.assert_array_equal(rays.colors[:, 0], [RED, BLUE])
    np.testing.assert_array_equal(points.points, [[1.0, 0.0, 0.0]])
    np.testing.assert_array_equal(points.colors, [RED])
    view.mark([])
    assert len(rays.points) == 0
    assert not points.visible


def test_a_marked_point_keeps_its_size_in_the_picture(client, view):
    view.mark([mark(1.0, RED)])
    before = client.node(POINTS_NODE).point_size
    client.camera.position = 0.5 * client.camera.position
    view.adapt_size()
    assert client.node(POINTS_NODE).point_size == pytest.approx(before / 2)


def test_one_sensor_is_drawn_as_selected(client, view):
    sensor, pose = fake_recording().sensors[0], np.eye(4)
    pose[:3, 3] = 1.0, 2.0, 3.0
    view.select(sensor, pose, RED)
    frustum = client.node(SELECTED_NODE)
    assert tuple(frustum.position) == (1.0, 2.0, 3.0)
    assert tuple(frustum.color) == RED
    view.select(sensor, np.full((4, 4), np.nan), RED)
    assert not frustum.visible
    view.select(None, pose, RED)
    assert client.scene.get_handle_by_name(SELECTED_NODE) is None
