from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from recordings import Cloud, RecordingError
from recordings.point_clouds import fields_of
from recordings.point_truth import _FrameTruth, _rows, truth_fields


def message(rows: np.ndarray, **more: object) -> SimpleNamespace:
    described: Any = rows.dtype.fields or {}
    codes = {"f4": 7, "u1": 2}
    fields = {
        "header": SimpleNamespace(frame_id="world"),
        "width": len(rows),
        "height": 1,
        "is_bigendian": False,
        "point_step": rows.dtype.itemsize,
        "row_step": rows.nbytes,
        "data": np.frombuffer(rows.tobytes(), np.uint8),
        "fields": [
            SimpleNamespace(name=n, offset=described[n][1], datatype=codes[described[n][0].str[1:]])
            for n in rows.dtype.names or ()
        ],
    }
    return SimpleNamespace(**(fields | more))


def test_fields_are_read_where_they_lie():
    rows = np.zeros(
        3,
        dtype={
            "names": ["x", "object"],
            "formats": ["<f4", "u1"],
            "offsets": [4, 9],
            "itemsize": 12,
        },
    )
    rows["x"], rows["object"] = [1, 2, 3], [0, 1, 2]
    table = truth_fields(message(rows))
    assert table["x"].tolist() == [1.0, 2.0, 3.0]
    assert table["object"].tolist() == [0, 1, 2]


@pytest.mark.parametrize("more", [{"point_step": 3}, {"width": 10}])
def test_a_cloud_that_does_not_fit_together_is_refused(more: dict[str, object]):
    rows = np.zeros(3, dtype=[("x", "<f4"), ("object", "u1")])
    with pytest.raises(RecordingError, match="does not fit together"):
        truth_fields(message(rows, **more))


@pytest.mark.parametrize(
    ("height", "said"), [(1, "does not fit together"), (2**32 - 1, "4294967295 points, more than")]
)
def test_a_cloud_without_fields_is_refused_however_tall_it_says_it_is(height: int, said: str):
    cloud = message(np.zeros(1, dtype=[("x", "<f4")]), height=height, point_step=0, row_step=0)
    cloud.fields, cloud.data = [], b""
    with pytest.raises(RecordingError, match=said):
        truth_fields(cloud)


def test_a_field_named_twice_is_refused():
    cloud = message(np.zeros(3, dtype=[("x", "<f4"), ("y", "<f4")]))
    cloud.fields[1].name = "x"
    with pytest.raises(RecordingError, match="does not fit together"):
        truth_fields(cloud)


def cloud_of(points: np.ndarray, sensor: list[int], zone: list[int]) -> Cloud:
    return Cloud(
        points=points,
        sensor=np.array(sensor),
        zone=np.array(zone),
        directions=np.full((2, 8, 8, 3), 1.0),
        ranges=np.full((2, 8, 8), np.nan),
        T_fixed_sensor=np.stack([np.eye(4)] * 2),
        stamp=0.0,
    )


def table_of(points: np.ndarray, **more: list[int]) -> dict[str, np.ndarray]:
    table = {axis: points[:, i] for i, axis in enumerate("xyz")}
    return table | {name: np.array(values) for name, values in more.items()}


POINTS = np.array([[0.0, 0, 1], [1.0, 0, 1], [5.0, 5, 5]])


def test_rows_are_found_by_sensor_and_zone():
    table = table_of(POINTS + 0.05, sensor=[1, 0, 0], zone=[3, 2, 9])
    assert _rows(table, cloud_of(POINTS, [1, 0, 1], [3, 2, 7])).tolist() == [0, 1, -1]


def test_zones_are_counted_in_the_sensors_own_grid():
    cloud = cloud_of(POINTS, [1, 0, 1], [8, 17, 9])
    directions = cloud.directions.copy()
    directions[1, 4:], directions[1, :, 4:] = np.nan, np.nan
    # The second sensor has 4 x 4 zones: its zone 4 is the first of its second row, 8 in the cloud.
    table = table_of(POINTS, sensor=[1, 0, 1], zone=[4, 17, 5])
    assert _rows(table, replace(cloud, directions=directions)).tolist() == [0, 1, 2]
    far = table_of(POINTS + 9.0, sensor=[1, 0, 1], zone=[4, 17, 5])
    assert _rows(far, replace(cloud, directions=directions)).tolist() == [-1, -1, -1]


def test_sensors_that_are_numbered_differently_are_matched_by_place():
    table = table_of(POINTS[[1, 0, 2]], sensor=[1, 0, 1], zone=[3, 2, 9])
    assert _rows(table, cloud_of(POINTS, [1, 0, 1], [3, 2, 9])).tolist() == [1, 0, 2]


def test_without_zones_rows_are_found_by_place_and_none_is_far_away():
    table = table_of(POINTS[:2])
    assert _rows(table, cloud_of(POINTS, [0, 0, 0], [0, 1, 2])).tolist() == [0, 1, -1]


def test_rows_that_lie_nowhere_belong_to_no_point():
    table = table_of(np.array([[np.nan, 0, 0], [1.0, 0, 1]]))
    assert _rows(table, cloud_of(POINTS, [0, 0, 0], [0, 1, 2])).tolist() == [-1, 1, -1]
    assert _rows(table_of(np.full((2, 3), np.nan)), cloud_of(POINTS, [0] * 3, [0] * 3)).max() == -1


def test_points_without_a_row_have_no_velocity_even_where_there_are_no_rows():
    truth = {name: np.array([7.0, 8.0]) for name in ("x", "y", "z", "vx", "vy", "vz")}
    velocity, objects = _FrameTruth(truth | {"object": np.array([0, 3])}).at(np.array([1, -1, 0]))
    np.testing.assert_array_equal(velocity[:, 0], [8.0, np.nan, 7.0])
    assert objects.tolist() == [3, -1, 0]
    nothing = {name: values[:0] for name, values in (truth | {"object": np.array([0])}).items()}
    velocity, objects = _FrameTruth(nothing).at(np.array([-1, -1]))
    assert np.isnan(velocity).all()
    assert objects.tolist() == [-1, -1]


def test_rows_of_an_organised_cloud_may_be_padded():
    rows = np.zeros(4, dtype=[("x", "<f4")])
    rows["x"] = [1, 2, 3, 4]
    padded = rows[:2].tobytes() + b"\xff" * 5 + rows[2:].tobytes()
    data = np.frombuffer(padded, np.uint8)
    cloud = message(rows, width=2, height=2, row_step=13, data=data)
    assert fields_of(cloud)["x"].tolist() == [1.0, 2.0, 3.0, 4.0]
