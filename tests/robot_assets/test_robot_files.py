"""Meshes and descriptions of robots, whole and broken."""

import warnings
from pathlib import Path

import numpy as np
import pytest
import trimesh

from robot_assets import RobotError, load_robot
from robot_assets.mesh_files import MeshError, MeshPlaces
from robot_assets.meshes import MOST_TRIANGLES
from tests.robot_assets.urdf import LINK, box_link, chain, joint, urdf


def test_simple_shapes_are_placed_and_sized():
    robot = load_robot(urdf(box_link("body", (0.2, 0.4, 0.6), (1, 2, 3))))
    assert robot.collision_meshes["body"].bounds == pytest.approx(
        np.array([(0.9, 1.8, 2.7), (1.1, 2.2, 3.3)])
    )
    assert robot.visual_meshes == {}


def with_mesh(filename: str, scale: str = "1 1 1") -> str:
    geometry = f'<geometry><mesh filename="{filename}" scale="{scale}"/></geometry>'
    return urdf(f'<link name="body"><collision>{geometry}</collision></link>')


@pytest.mark.parametrize(
    "filename",
    [
        "box.stl",
        "./box.stl",
        "package://bot/box.stl",
        "file://{folder}/box.stl",
        "{folder}/box.stl",
    ],
)
def test_a_mesh_beside_the_description_is_found(tmp_path, monkeypatch, filename):
    monkeypatch.chdir("/")
    trimesh.creation.box((1, 1, 1)).export(tmp_path / "box.stl")
    path = tmp_path / "robot.urdf"
    path.write_text(with_mesh(filename.format(folder=tmp_path), "0.1 0.2 0.3"))
    robot = load_robot(path)
    assert robot.mesh_warnings == []
    assert robot.collision_meshes["body"].extents == pytest.approx([0.1, 0.2, 0.3])


def test_a_mirrored_mesh_still_faces_outward(tmp_path):
    trimesh.creation.box((1, 1, 1)).export(tmp_path / "box.stl")
    path = tmp_path / "robot.urdf"
    path.write_text(with_mesh("box.stl", "1 -1 1"))
    assert load_robot(path).collision_meshes["body"].volume == pytest.approx(1.0)


def test_a_mesh_in_a_package_folder_above_is_found(tmp_path):
    (tmp_path / "bot" / "meshes").mkdir(parents=True)
    (tmp_path / "bot" / "urdf").mkdir()
    trimesh.creation.box((1, 1, 1)).export(tmp_path / "bot" / "meshes" / "box.stl")
    path = tmp_path / "bot" / "urdf" / "robot.urdf"
    path.write_text(with_mesh("package://bot/meshes/box.stl"))
    assert load_robot(path).mesh_warnings == []


def test_missing_meshes_are_named_and_the_rest_works(tmp_path):
    path = tmp_path / "robot.urdf"
    path.write_text(with_mesh("package://bot/gone.dae"))
    robot = load_robot(path)
    assert robot.mesh_warnings == [
        "A mesh or shape of tester is left out, package://bot/gone.dae: it is not found; --meshes "
        "names folders to look in; what it shows is neither drawn nor removed from the "
        "clouds."
    ]
    assert robot.collision_meshes == {}
    assert robot.link_poses({})["body"] == pytest.approx(np.eye(4))


@pytest.mark.parametrize(
    ("name", "content"),
    [("bad.stl", b"solid nonsense"), ("bad.dae", b"<x/>"), ("bad.obj", b"v 0 0 0\n")],
)
def test_a_broken_mesh_is_left_out_and_told(tmp_path, name, content):
    (tmp_path / name).write_bytes(content)
    path = tmp_path / "robot.urdf"
    path.write_text(with_mesh(name))
    robot = load_robot(path)
    assert robot.mesh_warnings == []
    assert robot.collision_meshes == {}
    (sentence,) = robot.mesh_warnings
    assert sentence.startswith(f"A mesh or shape of tester is left out, {name}: it ")
    assert "\n" not in sentence


def cube(folder: Path, name: str = "box.stl") -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    trimesh.creation.box((1, 1, 1)).export(folder / name)
    return folder / name


def test_a_recorded_description_reads_named_folders_and_packages_only(tmp_path, monkeypatch):
    cube(tmp_path / "ros/share/bot/meshes")
    cube(tmp_path / "mine/bot/meshes")
    outside = cube(tmp_path / "private")
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"/gone:{tmp_path / 'ros'}")
    monkeypatch.setenv("ROS_PACKAGE_PATH", "")

    def found(name: str, *folders: Path) -> bool:
        try:
            return MeshPlaces(folders).find(name).is_file()
        except MeshError:
            return False

    assert found("package://bot/meshes/box.stl")
    assert found(f"file://{tmp_path}/ros/share/bot/meshes/box.stl")
    assert not found("package://bot/../../../private/box.stl")
    assert not found("package://../../private/box.stl")
    for name in (f"file://{outside}", str(outside), "private/box.stl", "box.stl"):
        assert not found(name)
    assert not found("box.stl", tmp_path / "mine")
    assert not found("../private/box.stl", tmp_path / "mine")
    assert found("box.stl", outside.parent)
    assert found(str(outside), outside.parent)
    monkeypatch.setenv("AMENT_PREFIX_PATH", "")
    assert not found("package://bot/meshes/box.stl")
    assert found("package://bot/meshes/box.stl", tmp_path / "mine")
    assert found("package://bot/meshes/box.stl", tmp_path / "mine" / "bot")
    (tmp_path / "mine" / "link.stl").symlink_to(outside)
    assert found("link.stl", tmp_path / "mine")  # as colcon build --symlink-install makes them
    (tmp_path / "mine" / "folder").symlink_to(outside.parent)
    assert not found("folder/../private/box.stl", tmp_path / "mine")


def test_a_recorded_description_with_a_path_of_this_machine_shows_nothing_of_it(tmp_path):
    inside = load_robot(with_mesh(f"file://{cube(tmp_path)}"))
    assert inside.collision_meshes == {}
    assert "box.stl: it is not found; " in inside.mesh_warnings[0]


@pytest.mark.parametrize(
    "name", ["x" * 5000 + ".stl", "http://127.0.0.1:9/a.stl", "package://", "meshes.zip", "/"]
)
def test_names_that_are_no_files_are_left_out_and_told(tmp_path, name):
    (tmp_path / "meshes.zip").write_bytes(b"PK")
    robot = load_robot(with_mesh(name), [tmp_path])
    assert robot.collision_meshes == {}
    assert len(robot.mesh_warnings) == 1


def shape(geometry: str) -> str:
    return urdf(f'<link name="body"><collision><geometry>{geometry}</geometry></collision></link>')


@pytest.mark.parametrize(
    ("geometry", "reason"),
    [
        ('<box size="1"/>', "its size cannot be 1"),
        ('<box size="inf 1 1"/>', "its size cannot be inf 1 1"),
        ('<cylinder radius="nan" length="1"/>', "its radius and length cannot be nan 1"),
        ('<cylinder radius="1" length="-1"/>', "its radius and length cannot be 1 -1"),
        ('<sphere radius="1e308"/>', "its radius cannot be 1e+308"),
        ('<capsule radius="1" length="1"/>', "it is none of box, cylinder, sphere, mesh"),
        ("", "it is none of box, cylinder, sphere, mesh"),
    ],
)
def test_a_shape_that_cannot_be_is_left_out_and_told(geometry, reason):
    with warnings.catch_warnings(action="error"):
        robot = load_robot(shape(geometry))
        assert robot.collision_meshes == {}
    (sentence,) = robot.mesh_warnings
    assert sentence.startswith(
        f"A mesh or shape of tester is left out, a shape of link body: {reason}"
    )


def test_triangles_are_bounded():
    sphere = '<collision><geometry><sphere radius="0.1"/></geometry></collision>'
    robot = load_robot(urdf(f'<link name="body">{sphere}</link>', name="one"))
    each = len(robot.collision_meshes["body"].faces)
    count = MOST_TRIANGLES // each + 5
    robot = load_robot(urdf(f'<link name="body">{sphere * count}</link>', name="many"))
    assert len(robot.collision_meshes["body"].faces) == (count - 5) * each
    assert "the robot has more than 400000 triangles" in robot.mesh_warnings[0]


def test_shapes_are_bounded(monkeypatch):
    monkeypatch.setattr("robot_assets.meshes.MOST_SHAPES", 2)
    box = '<collision><geometry><box size="1 1 1"/></geometry></collision>'
    robot = load_robot(urdf(f'<link name="body">{box * 3}</link>', name="boxes"))
    assert len(robot.collision_meshes["body"].faces) == 2 * 12
    assert "the robot has more than 2 shapes" in robot.mesh_warnings[0]


def test_a_mesh_of_too_many_triangles_is_left_out(tmp_path, monkeypatch):
    cube(tmp_path)
    monkeypatch.setattr("robot_assets.meshes.MOST_TRIANGLES", 11)
    robot = load_robot(with_mesh("box.stl"), [tmp_path])
    assert robot.collision_meshes == {}
    assert "it has 12 triangles, and 11 are left for it" in robot.mesh_warnings[0]
    cube(tmp_path, "large.stl")
    monkeypatch.setattr("robot_assets.mesh_files.LARGEST_FILE", 600)
    robot = load_robot(with_mesh("large.stl"), [tmp_path])
    assert robot.collision_meshes == {}
    assert "it has 684 bytes, more than 600" in robot.mesh_warnings[0]


LOOP = urdf(
    LINK.format("a"), LINK.format("b"), joint("j", "a", "b", "fixed"), joint("k", "b", "a", "fixed")
)


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (b"", "no element found"),
        (b"hello", "syntax error"),
        (b"\xff\xfe\x00", "not a text file"),
        (b'<robot name="r"><link name="a">', "is not a URDF"),
        (b"<sdf/>", "must be a <robot> with a name"),
        (b'<robot><link name="a"/></robot>', "must be a <robot> with a name"),
        (b'<robot name="r"/>', "has no links"),
        (LOOP.encode(), "not a URDF that can be used"),
        (urdf(LINK.format("a"), joint("j", "gone", "a")).encode(), "not a URDF that can be used"),
    ],
)
def test_a_broken_description_is_one_sentence_that_names_it(tmp_path, capfd, content, reason):
    path = tmp_path / "robot.urdf"
    path.write_bytes(content)
    with pytest.raises(RobotError) as caught:
        load_robot(path)
    sentence = str(caught.value)
    assert sentence.startswith(str(path))
    assert reason in sentence
    assert "\n" not in sentence
    assert capfd.readouterr() == ("", ""), "the sentence is all that a person gets to read"


def test_a_file_that_is_not_there(tmp_path):
    path = tmp_path / "gone.urdf"
    with pytest.raises(
        RobotError, match=r"gone.urdf cannot be read as a URDF file: No such file or directory\.$"
    ):
        load_robot(path)


@pytest.mark.parametrize("declaration", ["", "\n ", '<?xml version="1.0" encoding="utf-8"?>'])
def test_a_text_is_a_description(declaration):
    robot = load_robot(declaration + chain("joint1"))
    assert robot.name == "tester"
    assert robot.links == ("link0", "link1")


def test_a_broken_text_is_said_too():
    with pytest.raises(RobotError, match=r"^The robot description is not a URDF"):
        load_robot("<robot")


def test_mesh_files_are_bounded_together_and_each_is_read_once(tmp_path, monkeypatch):
    size = cube(tmp_path, "a.stl").stat().st_size
    cube(tmp_path, "b.stl")
    monkeypatch.setattr("robot_assets.meshes.MOST_BYTES", size + 1)
    shape = '<collision><geometry><mesh filename="{}.stl"/></geometry></collision>'
    shapes = "".join(map(shape.format, "aaab"))
    robot = load_robot(urdf(f'<link name="body">{shapes}</link>', name="cubes"), [tmp_path])
    assert len(robot.collision_meshes["body"].faces) == 3 * 12
    assert (
        f"b.stl: the robot's mesh files have more than {size + 1} bytes" in robot.mesh_warnings[0]
    )
