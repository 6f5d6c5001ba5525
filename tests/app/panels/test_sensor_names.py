"""Names below the sensors' images, and the rows that they stand in."""

import pytest

from app.panels.sensor_names import captions, groups, short_names


@pytest.mark.parametrize(
    ("names", "short"),
    [
        (["base/0", "elbow/1", "end_effector/2"], ["base/0", "elbow/1", "ee/2"]),
        (["rig/sensor_0", "rig/sensor_12"], ["0", "12"]),
        (["tof/front"], ["tof/front"]),
        (["a_very_long/1", "another_very_long/1"], ["avl/1", "avl/1"]),
    ],
)
def test_names_are_short_and_stay_different(names, short):
    found = short_names(names)
    assert found == (short if len(set(short)) == len(names) else names)


def test_sensors_of_one_name_and_a_number_stand_in_a_row():
    names = [f"{part}/{k}" for part in ("base", "end_effector") for k in range(3)]
    assert groups(names) == [("base", [0, 1, 2]), ("end_effector", [3, 4, 5])]
    assert captions(names) == ["0", "1", "2"] * 2


@pytest.mark.parametrize(
    "names",
    [
        ["tof/front"],
        ["left", "right"],
        ["base/0", "base/1", "elbow/0"],  # a row of its own for one alone
        ["x0", "x1", "x2"],
        [f"{part}{k}" for part in "ab" for k in range(20)],  # too long for a row
    ],
)
def test_other_sensors_stand_in_one_grid(names):
    assert groups(names) == [("", list(range(len(names))))]
    assert captions(names) == short_names(names)
