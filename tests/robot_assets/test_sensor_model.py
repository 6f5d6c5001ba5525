"""Rays of the zones, what a reading means, and how drivers deliver them."""

import numpy as np
import pytest

from robot_assets import SensorModel, zone_rays

TAN = np.tan(np.pi / 8)


def test_the_outer_edges_of_the_outer_zones_bound_45_degrees():
    directions = SensorModel().directions
    half_zone = (directions[0, 1, 0] - directions[0, 0, 0]) / 2
    assert directions[0, 0, 0] - half_zone == pytest.approx(-TAN)
    assert directions[0, 7, 0] + half_zone == pytest.approx(TAN)
    assert directions[0, 0, 1] - half_zone == pytest.approx(-TAN)
    assert directions[7, 0, 1] + half_zone == pytest.approx(TAN)


def test_the_corner_zone_looks_along_its_centre():
    assert SensorModel().directions[0, 0] == pytest.approx((-0.3624, -0.3624, 1.0), abs=1e-4)
    assert SensorModel().directions[7, 7] == pytest.approx((7 / 8 * TAN, 7 / 8 * TAN, 1.0))


def test_rows_run_down_and_columns_right():
    directions = SensorModel().directions
    assert directions.shape == (8, 8, 3)
    assert (np.diff(directions[:, :, 1], axis=0) > 0).all()
    assert (np.diff(directions[:, :, 0], axis=1) > 0).all()
    assert directions[:, :, 0] == pytest.approx(-directions[:, ::-1, 0])
    assert directions[:, :, 1] == pytest.approx(-directions[::-1, :, 1])


def test_a_perpendicular_reading_is_the_depth():
    model = SensorModel(distance="perpendicular")
    wall = 1.5 * model.directions
    assert wall[..., 2] == pytest.approx(np.full((8, 8), 1.5))


def test_a_radial_reading_is_the_distance():
    model = SensorModel(distance="radial")
    sphere = 1.5 * model.directions
    assert np.linalg.norm(sphere, axis=-1) == pytest.approx(np.full((8, 8), 1.5))
    straight = SensorModel().directions
    assert model.directions == pytest.approx(
        straight / np.linalg.norm(straight, axis=-1, keepdims=True)
    )


def test_a_pinhole_camera_with_its_axis_off_the_middle():
    rays = zone_rays(rows=2, columns=3, fx=2.0, fy=4.0, cx=1.0, cy=0.0)
    assert rays[0, 1].tolist() == [0.0, 0.0, 1.0]
    assert rays[1, 2].tolist() == [0.5, 0.25, 1.0]
    assert rays.shape == (2, 3, 3)


# Up to down, left to right, as the world is seen looking outward.
SEEN = np.array([(1.0, 2.0, 3.0), (4.0, 5.0, 6.0), (7.0, 8.0, 9.0)])


@pytest.mark.parametrize(
    ("settings", "delivered"),
    [
        ({}, SEEN),
        ({"flip_vertical": True}, SEEN[::-1]),
        ({"flip_horizontal": True}, SEEN[:, ::-1]),
        ({"flip_vertical": True, "flip_horizontal": True}, SEEN[::-1, ::-1]),
        ({"reading_order": "column_major"}, SEEN.T),
        ({"reading_order": "column_major", "flip_vertical": True}, SEEN[::-1].T),
        ({"reading_order": "column_major", "flip_horizontal": True}, SEEN[:, ::-1].T),
    ],
)
def test_readings_come_out_as_the_world_is_seen(settings, delivered):
    model = SensorModel(rows=3, columns=3, **settings)
    assert model.arrange(np.ascontiguousarray(delivered)).tolist() == SEEN.tolist()


@pytest.mark.parametrize("shape", [(2, 3), (3, 2)])
def test_readings_down_the_columns_come_out_in_rows_whatever_the_image_is_called(shape):
    seen = np.array([(1, 2, 3), (4, 5, 6)])
    delivered = np.array([1, 4, 2, 5, 3, 6], dtype=np.uint8).reshape(shape)
    model = SensorModel(rows=2, columns=3, reading_order="column_major")
    assert model.arrange(delivered).tolist() == seen.tolist()
    assert model.delivers(*shape)
    assert SensorModel(rows=2, columns=3).delivers(*shape) == (shape == (2, 3))


@pytest.mark.parametrize(("rows", "columns"), [(4, 4), (4, 8), (3, 2), (64, 64)])
@pytest.mark.parametrize(("across", "down"), [(60, None), (41, 52), (120, 20)])
def test_any_grid_fills_its_field_of_view(rows, columns, across, down):
    vertical = None if down is None else np.radians(down)
    model = SensorModel(
        rows=rows,
        columns=columns,
        field_of_view=np.radians(across),
        vertical_field_of_view=vertical,
    )
    half_width = np.tan(np.radians(across / 2))
    half_height = np.tan(np.radians((across if down is None else down) / 2))
    corner = model.directions[-1, -1]
    assert corner == pytest.approx(
        (half_width * (1 - 1 / columns), half_height * (1 - 1 / rows), 1.0)
    )


def test_as_depth_images_readings_are_in_order_and_along_the_axis():
    odd = SensorModel(
        rows=4, columns=4, distance="radial", reading_order="column_major", flip_vertical=True
    )
    assert odd.of_depth_images() == SensorModel(rows=4, columns=4)
