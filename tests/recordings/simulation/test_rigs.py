"""Simulation with rigs that are not the paper's."""

from dataclasses import replace
from itertools import islice
from pathlib import Path

import numpy as np
import pytest

from recordings import Frame, Provenance, open_recording
from recordings.simulation import IMPERFECTIONS, NOISE_MODELS, SCENARIOS
from recordings.simulation.body import SURROUNDINGS
from recordings.writer import RecordingWriter
from robot_assets import Rig, RigError, Sensor, SensorModel, rig_text
from robot_assets.rig import look
from tests.recordings.simulation.made import ROBOT, frames, written

CEILING = 1.95
"""Metres above the robot's base."""
HEIGHT = 0.5
PLACE = np.array([0.3, -0.45, HEIGHT])
"""Of the sensor that looks up: beside the robot, with nothing but the ceiling in view."""
COARSE = SensorModel(name="coarse", rows=4, columns=4, field_of_view=np.pi / 3)
X, Y, Z = np.eye(3)


def rig(model: SensorModel = COARSE) -> Rig:
    up = Sensor("up", "", "panda_link0", look(PLACE, Z, Y))
    left = Sensor("fingers/left", "fingers", "panda_leftfinger", look(0.05 * Y, Y, Z))
    right = Sensor("fingers/right", "fingers", "panda_rightfinger", look(-0.05 * Y, -Y, Z))
    return Rig("three that look", model, (left, right, up))


def few(path: Path, of: Rig, count: int = 2, noise: str = "none") -> list[Frame]:
    """The first frames of a recording, and the file that holds them."""
    about = Provenance(True, "towards", 0.6, 1, 0, noise, "made for a test", rig=of.name)
    made = list(islice(frames(SCENARIOS["towards"], noise=noise, rig=of), count))
    with RecordingWriter(path, ROBOT, of, about) as writer:
        for frame in made:
            writer.write(frame)
    return made


@pytest.mark.parametrize(
    "model",
    [
        COARSE,
        replace(COARSE, distance="radial"),
        replace(COARSE, flip_vertical=True, reading_order="column_major", distance="radial"),
        replace(COARSE, rows=3, columns=5),
        replace(COARSE, rows=6, columns=2, vertical_field_of_view=np.radians(50)),
        replace(COARSE, rows=2, columns=2, field_of_view=np.radians(15)),
    ],
    ids=["coarse", "radial", "another driver", "rectangle", "two angles", "narrow"],
)
def test_points_lie_on_the_ceiling_where_the_zones_look(tmp_path: Path, model: SensorModel):
    path = tmp_path / "x.mcap"
    few(path, rig(model))
    half_width = np.tan(model.field_of_view / 2) * (1 - 1 / model.columns)
    down = model.vertical_field_of_view or model.field_of_view
    half_height = np.tan(down / 2) * (1 - 1 / model.rows)
    # Looking up with the upper side along y, right is along -x, and down along -y.
    depth = CEILING - HEIGHT
    x = PLACE[0] - depth * np.linspace(-half_width, half_width, model.columns)
    y = PLACE[1] - depth * np.linspace(-half_height, half_height, model.rows)
    expected = np.stack([*np.meshgrid(x, y), np.full((model.rows, model.columns), CEILING)], -1)
    for chosen in (None, rig(model)):
        with open_recording(path, rig=chosen) as recording:
            assert recording.warnings == ()
            number = [sensor.name for sensor in recording.sensors].index("up")
            cloud = recording.cloud(1)
            # Images hold whole millimetres.
            np.testing.assert_allclose(
                cloud.points[cloud.sensor == number], expected.reshape(-1, 3), atol=6e-4
            )
            np.testing.assert_allclose(cloud.ranges[number], depth, atol=6e-4)
            rays = cloud.directions[number]
            np.testing.assert_allclose(rays[0, 0, :2] / rays[0, 0, 2], [-half_width, -half_height])


def test_every_point_has_its_truth(tmp_path: Path):
    path = tmp_path / "x.mcap"
    few(path, rig())
    with open_recording(path) as recording:
        for k in range(2):
            cloud, velocity = recording.cloud(k), recording.point_truth(k)
            assert velocity is not None
            assert len(velocity) == len(cloud.points) > 16
            assert np.isfinite(velocity).all()


def test_truth_is_where_exact_readings_are_however_a_sensor_measures():
    for model in (COARSE, replace(COARSE, distance="radial")):
        frame = next(frames(SCENARIOS["towards"], rig=rig(model)))
        up = frame.truth.sensor == 2
        assert (frame.truth.object[up] == SURROUNDINGS).all()
        away = np.linalg.norm(frame.truth.points[up] - PLACE, axis=1)
        slant = np.linalg.norm(COARSE.directions, axis=-1)
        read = frame.ranges[2] * (1.0 if model.distance == "radial" else slant)
        assert away.reshape(4, 4) == pytest.approx(read)
        if model.distance == "perpendicular":
            np.testing.assert_allclose(frame.truth.points[up][:, 2], CEILING, atol=1e-5)


@pytest.mark.parametrize("noise", NOISE_MODELS)
def test_all_that_can_be_wrong_can_be_wrong_with_few_zones(noise: str):
    small = rig(replace(COARSE, rows=2, columns=3))
    made = list(
        islice(
            frames(
                SCENARIOS["towards"], noise=noise, imperfections=tuple(IMPERFECTIONS), rig=small
            ),
            3,
        )
    )
    for frame in made:
        assert frame.status is not None
        assert frame.ranges.shape == frame.status.shape == (3, 2, 3)
        valid = np.isfinite(frame.ranges) & (frame.status == 5)
        assert valid.sum() == len(frame.truth.points)
        assert frame.truth.zone.max(initial=0) < 6


def test_a_recording_says_with_which_rig_it_was_made(tmp_path: Path):
    mine = rig()
    path = written(tmp_path / "x.mcap", "fast", 2.0, rig=mine)
    with open_recording(path) as recording:
        assert recording.provenance is not None
        assert recording.provenance.rig == "three that look"
        assert " --noise none --rig rig.toml --out x.mcap" in recording.provenance.command
        assert recording.rig is not None
        assert rig_text(recording.rig) == rig_text(mine)
        assert {(s.name, s.ring) for s in recording.sensors} == {
            ("up", ""),
            ("fingers/left", "fingers"),
            ("fingers/right", "fingers"),
        }


def test_sensors_with_equal_ends_of_topics_keep_the_names_of_the_rig_in_the_file(tmp_path: Path):
    names = ["left arm/front/0", "right arm/front/0", "right arm/front/1"]
    places = [replace(rig().sensors[0], name=name, ring=name[:-2]) for name in names]
    path = tmp_path / "x.mcap"
    few(path, replace(rig(), sensors=tuple(places)))
    with open_recording(path) as recording:
        assert recording.warnings == ()
        assert [(s.name, s.ring) for s in recording.sensors] == [(n, n[:-2]) for n in names]
        assert {s.grid for s in recording.sensors} == {(4, 4)}


def test_a_rig_on_links_that_the_robot_has_not_is_refused(tmp_path: Path):
    other = replace(rig(), sensors=(Sensor("eye", "", "wheel", np.eye(4)),))
    with pytest.raises(RigError, match="fixes sensor eye to link wheel, which the robot panda"):
        written(tmp_path / "x.mcap", "fast", 2.0, rig=other)
    assert list(tmp_path.iterdir()) == []
