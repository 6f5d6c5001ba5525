"""Meshes and descriptions of robots, whole and broken."""

import numpy as np
import pytest
import trimesh

from robot_assets import RobotError, load_robot
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
    assert robot.missing_meshes == ()
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
    assert load_robot(path).missing_meshes == ()


def test_missing_meshes_are_named_and_the_rest_works(tmp_path):
    path = tmp_path / "robot.urdf"
    path.write_text(with_mesh("package://bot/gone.dae"))
    robot = load_robot(path)
    assert robot.missing_meshes == ("package://bot/gone.dae",)
    assert robot.collision_meshes == {}
    assert robot.link_poses({})["body"] == pytest.approx(np.eye(4))


@pytest.mark.parametrize(
    ("name", "content"),
    [("bad.stl", b"solid nonsense"), ("bad.dae", b"<x/>"), ("bad.obj", b"v 0 0 0\n")],
)
def test_a_broken_mesh_is_one_sentence_that_names_it(tmp_path, name, content):
    (tmp_path / name).write_bytes(content)
    path = tmp_path / "robot.urdf"
    path.write_text(with_mesh(name))
    robot = load_robot(path)
    with pytest.raises(RobotError) as caught:
        _ = robot.collision_meshes
    assert str(caught.value).startswith(f"The mesh {tmp_path / name} ")
    assert "\n" not in str(caught.value)


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
