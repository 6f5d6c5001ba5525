from dataclasses import replace

import numpy as np
import pytest

from robot_assets import Rig, RigError, Sensor, SensorModel, load_rig, parse_rig, rig_text


def same(one: Rig, other: Rig) -> None:
    assert (one.name, one.model) == (other.name, other.model)
    for a, b in zip(one.sensors, other.sensors, strict=True):
        assert (a.name, a.ring, a.link) == (b.name, b.ring, b.link)
        assert a.T_link_sensor == pytest.approx(b.T_link_sensor, abs=1e-14)


def again(rig: Rig) -> Rig:
    return parse_rig(rig_text(rig).encode("utf-8"), "the text")


def test_the_papers_rig_comes_back():
    same(again(load_rig()), load_rig())


@pytest.mark.parametrize("angle", [0.7, np.pi / 3, np.pi / 7, np.radians(63.0)])
def test_a_rig_made_in_code_comes_back(angle: float):
    turned = np.eye(4)
    turned[:3, :3] = [[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]]
    turned[:3, 3] = [0.1, -1e-7, 1 / 3]
    model = SensorModel(
        name="own",
        rows=3,
        columns=64,
        field_of_view=angle,
        vertical_field_of_view=0.5,
        min_range=0.0,
        max_range=1.25,
        distance="radial",
        reading_order="column_major",
        flip_horizontal=True,
    )
    sensors = (Sensor("a/0", "a", "flange", turned), Sensor("b", "", "base", np.eye(4)))
    same(again(Rig("mine", model, sensors)), Rig("mine", model, sensors))


def test_any_name_comes_back():
    name = 'a "quoted" \\ name\nof \t two \x7f lines, größer 🤖'
    rig = replace(load_rig(), name=name)
    assert again(rig).name == name


@pytest.mark.parametrize(
    ("rig", "said"),
    [
        (
            replace(load_rig(), sensors=()),
            r"^No file can hold the rig '.*': there must be at least ",
        ),
        (
            replace(load_rig(), model=SensorModel(rows=1)),
            "sensor_model.rows must be a whole number from 2 to 64, got 1",
        ),
        (
            replace(load_rig(), sensors=(Sensor("a", "", "base", np.full((4, 4), np.nan)),)),
            r"sensors\[0\].position_m must be three numbers, got \[nan, nan, nan\]",
        ),
        (
            replace(load_rig(), sensors=2 * (Sensor("{a}", "", "base", np.eye(4)),)),
            r"two sensors have the name '\{a\}'",
        ),
    ],
)
def test_a_rig_that_could_not_be_read_again_is_not_written(rig: Rig, said: str):
    with pytest.raises(RigError, match=said):
        rig_text(rig)


def test_an_angle_is_written_as_a_person_would():
    model = SensorModel(field_of_view=np.radians(60.0))
    assert "field_of_view_deg = 60.0\n" in rig_text(replace(load_rig(), model=model))
