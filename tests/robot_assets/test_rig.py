"""The paper's rig, rigs of a user's own, and files that are none."""

import numpy as np
import pytest

from robot_assets import Rig, RigError, load_rig, load_robot
from tests.robot_assets.rig_files import HEAD, PAPER, RING, SINGLE, rig_of


@pytest.fixture(scope="module")
def rig() -> Rig:
    return load_rig()


def test_the_papers_rig_has_three_rings_of_eight(rig):
    rings = [sensor.ring for sensor in rig.sensors]
    assert len(rig.sensors) == 24
    assert rings == ["base"] * 8 + ["elbow"] * 8 + ["end_effector"] * 8
    assert len({sensor.name for sensor in rig.sensors}) == 24
    assert {s.ring: s.link for s in rig.sensors} == {
        "base": "panda_link0",
        "elbow": "panda_link5",
        "end_effector": "panda_link7",
    }


def test_its_sensors_are_vl53l5cx(rig):
    model = rig.model
    assert (model.name, model.rows, model.columns) == ("VL53L5CX", 8, 8)
    assert model.field_of_view == pytest.approx(np.pi / 4)
    assert (model.min_range, model.max_range) == (0.02, 4.0)
    assert (model.distance, model.reading_order) == ("perpendicular", "row_major")
    assert (model.flip_vertical, model.flip_horizontal) == (False, False)


@pytest.mark.parametrize("ring", ["base", "elbow", "end_effector"])
def test_a_ring_is_equally_spaced_and_looks_outward(rig, ring):
    poses = np.array([s.T_link_sensor for s in rig.sensors if s.ring == ring])
    positions, forward, up = poses[:, :3, 3], poses[:, :3, 2], -poses[:, :3, 1]
    centre = positions.mean(axis=0)
    spokes = positions - centre
    radius = np.linalg.norm(spokes, axis=1)
    assert radius == pytest.approx(np.full(8, radius[0]))
    assert radius[0] > 0.05
    assert forward == pytest.approx(spokes / radius[:, None], abs=1e-9)
    assert up == pytest.approx(np.broadcast_to(up[0], (8, 3)))
    assert forward @ up[0] == pytest.approx(np.zeros(8), abs=1e-9)

    following = np.roll(forward, -1, axis=0)
    assert np.einsum("ij,ij->i", forward, following) == pytest.approx(np.full(8, np.cos(np.pi / 4)))
    # Counter-clockwise about the axis, which is where the up side points.
    assert np.cross(forward, following) @ up[0] == pytest.approx(np.full(8, np.sin(np.pi / 4)))


def test_every_optical_frame_is_right_handed(rig):
    for sensor in rig.sensors:
        R = sensor.T_link_sensor[:3, :3]
        assert np.allclose(R.T @ R, np.eye(3), atol=1e-12)
        assert np.linalg.det(R) == pytest.approx(1.0)
        assert sensor.T_link_sensor[3].tolist() == [0, 0, 0, 1]


def test_its_links_are_the_pandas(rig):
    robot = load_robot()
    rig.check_links(robot.links, robot.name)
    with pytest.raises(
        RigError, match=r"fixes sensor base/0 to link panda_link0, which .* does not have"
    ):
        rig.check_links(("other",), "stick")


@pytest.mark.parametrize("ring", ["base", "elbow", "end_effector"])
def test_its_sensors_clear_the_body_they_sit_on(rig, ring):
    robot = load_robot()
    for sensor in (s for s in rig.sensors if s.ring == ring):
        mesh = robot.collision_meshes[sensor.link]
        assert not mesh.contains([sensor.T_link_sensor[:3, 3]])[0], sensor.name


def test_a_copy_is_the_same_rig(tmp_path, rig):
    copy = rig_of(tmp_path, PAPER)
    assert (copy.name, copy.model) == (rig.name, rig.model)
    for one, other in zip(copy.sensors, rig.sensors, strict=True):
        assert (one.name, one.ring, one.link) == (other.name, other.ring, other.link)
        assert one.T_link_sensor.tolist() == other.T_link_sensor.tolist()


def test_an_edited_copy_is_what_was_written(tmp_path):
    text = (
        (HEAD + RING).replace("count = 8", "count = 4").replace("radius_m = 0.085", "radius_m = 1")
    )
    text = text.replace("field_of_view_deg = 45.0", "field_of_view_deg = 60")
    text = text.replace('distance = "perpendicular"', 'distance = "radial"')
    text = text.replace("flip_vertical = false", "flip_vertical = true")
    rig = rig_of(tmp_path, text)
    assert rig.model.field_of_view == pytest.approx(np.pi / 3)
    assert (rig.model.distance, rig.model.flip_vertical) == ("radial", True)
    assert [s.name for s in rig.sensors] == ["base/0", "base/1", "base/2", "base/3"]
    positions = np.array([s.T_link_sensor[:3, 3] for s in rig.sensors])
    assert positions == pytest.approx(
        np.array([(1, 0, 0.19), (0, 1, 0.19), (-1, 0, 0.19), (0, -1, 0.19)]), abs=1e-12
    )


def test_a_single_sensor_looks_forward_with_its_up_side_up(tmp_path):
    (sensor,) = rig_of(tmp_path, HEAD + SINGLE).sensors
    assert (sensor.name, sensor.ring, sensor.link) == ("wrist", "", "panda_hand")
    # Looking along x with z up, right is -y and down is -z: columns of the optical frame x, y, z.
    assert sensor.T_link_sensor == pytest.approx(
        np.array([(0, 0, 1, 0.05), (-1, 0, 0, 0.0), (0, -1, 0, 0.03), (0, 0, 0, 1)])
    )


def test_a_field_of_view_may_differ_across_and_down(tmp_path):
    rig = rig_of(tmp_path, (HEAD + RING).replace("= 45.0", "= [41.0, 52]"))
    assert rig.model.field_of_view == pytest.approx(np.radians(41))
    assert rig.model.vertical_field_of_view == pytest.approx(np.radians(52))


def test_a_single_sensor_may_belong_to_a_ring(tmp_path):
    (sensor,) = rig_of(tmp_path, HEAD + SINGLE + 'ring = "arm"\n').sensors
    assert sensor.ring == "arm"


def test_rings_and_single_sensors_together(tmp_path):
    names = [s.name for s in rig_of(tmp_path, HEAD + RING + SINGLE).sensors]
    assert names == [f"base/{i}" for i in range(8)] + ["wrist"]


def test_a_rig_needs_a_sensor(tmp_path):
    with pytest.raises(RigError, match=r"there must be at least one of \[\[rings\]\] and"):
        rig_of(tmp_path, HEAD)


def test_names_are_unique(tmp_path):
    with pytest.raises(RigError, match="two sensors have the name 'base/0'"):
        rig_of(tmp_path, HEAD + RING + RING)


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("Base 0", "the names 'base/0' and 'Base 0' must differ in letters or digits"),
        ("/-/", "the name '/-/' of a sensor must have a letter or a digit."),
    ],
)
def test_names_must_be_told_apart_in_topics(tmp_path, name, sentence):
    with pytest.raises(RigError, match=sentence):
        rig_of(tmp_path, HEAD + RING + SINGLE.replace("wrist", name))


def test_a_rig_has_at_most_a_thousand_sensors(tmp_path):
    many = RING.replace("count = 8", "count = 1000")
    with pytest.raises(RigError, match="there must be at most 1000 sensors, found 1001"):
        rig_of(tmp_path, HEAD + many + SINGLE)
    assert len(rig_of(tmp_path, HEAD + many).sensors) == 1000


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (b"name = ", "is not a TOML file: "),
        (b"\xff\xfe", "is not a text file, so it cannot be a rig file."),
        (b"name = " + 10_000 * b"1", "holds a number of thousands of digits; "),
        (b"name = " + 10_000 * b"[", "has too deeply nested lists or tables."),
    ],
)
def test_what_is_no_toml(tmp_path, content, sentence):
    path = tmp_path / "my_rig.toml"
    path.write_bytes(content)
    with pytest.raises(RigError) as caught:
        load_rig(path)
    assert str(caught.value).startswith(f"{path} {sentence}")
    assert "\n" not in str(caught.value)


def test_a_file_that_is_too_large_is_not_read_to_its_end(tmp_path):
    path = tmp_path / "recording.mcap"
    with path.open("wb") as file:
        file.truncate(100_000_000_000)  # a hole, which takes no place
    with pytest.raises(RigError, match="has more than 1000000 bytes, too many for a rig file"):
        load_rig(path)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(
        RigError, match=r"gone.toml cannot be read as a rig file: No such file or directory\.$"
    ):
        load_rig(tmp_path / "gone.toml")
