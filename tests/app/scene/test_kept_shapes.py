"""Shapes of robots are kept between runs, and never older than what they are made of."""

from pathlib import Path

import numpy as np
import pytest
import trimesh

from app.scene import kept_shapes, shapes
from app.scene.shapes import robot_shape
from robot_assets import Robot, load_robot

URDF = (
    '<robot name="one"><link name="base"><visual><geometry><mesh filename="{}"/></geometry>'
    '<material name="m"><color rgba="{} 0.5 0.5 1"/></material></visual></link></robot>'
)


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    shapes._robot_shape.cache_clear()
    return tmp_path / "cache"


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The links whose parts were made from meshes."""
    found: list[str] = []
    real = shapes._parts
    monkeypatch.setattr(shapes, "_parts", lambda mesh: found.append("made") or real(mesh))
    return found


def robot(folder: Path, size: float = 1.0, red: float = 0.5, name: str = "box.stl") -> Robot:
    """A robot whose link is a box in a file."""
    trimesh.creation.box(extents=(size, 1, 1)).export(folder / name)
    place = folder / f"robot{size}{red}{name}.urdf"
    place.write_text(URDF.format(name, red))
    return load_robot(place)


def again(robot: Robot):
    """The shape, as another run would get it."""
    shapes._robot_shape.cache_clear()
    return robot_shape(robot)


def test_a_kept_shape_is_the_same_and_its_meshes_are_not_read(made):
    first = robot_shape(load_robot())
    assert made
    made.clear()
    second = again(load_robot())
    assert made == []
    assert second.digest == first.digest
    assert list(second.links) == list(first.links)
    for link, parts in first.links.items():
        for one, two in zip(parts, second.links[link], strict=True):
            np.testing.assert_array_equal(one.vertices, two.vertices)
            np.testing.assert_array_equal(one.faces, two.faces)
            assert (one.vertices.dtype, one.faces.dtype) == (two.vertices.dtype, two.faces.dtype)
            assert one.colour == two.colour


def test_another_description_and_another_file_are_another_shape(tmp_path, made):
    first = again(robot(tmp_path))
    again(robot(tmp_path, red=0.9))
    assert len(made) == 2
    assert again(robot(tmp_path, size=2.0)).digest != first.digest
    assert len(made) == 3


def test_a_file_that_refers_to_others_is_not_kept(tmp_path, cache, made):
    for _ in range(2):
        again(robot(tmp_path, name="box.obj"))
    assert len(made) == 2
    assert list(cache.rglob("*.npz")) == []


def test_a_robot_of_which_something_is_left_out_is_read_every_time(tmp_path, made):
    (tmp_path / "bad.stl").write_bytes(b"solid nothing")
    place = tmp_path / "bad.urdf"
    place.write_text(URDF.format("bad.stl", 0.5))
    for _ in range(2):
        bad = load_robot(place)
        assert again(bad).links == {}
        assert bad.mesh_warnings
        load_robot.__globals__["_robot"].cache_clear()


@pytest.mark.parametrize("content", [b"", b"nonsense", b"PK\x03\x04"])
def test_a_broken_file_is_made_again(tmp_path, cache, made, content):
    first = again(robot(tmp_path))
    [kept] = cache.rglob("*.npz")
    kept.write_bytes(content)
    assert again(robot(tmp_path)).digest == first.digest
    assert len(made) == 2
    again(robot(tmp_path))
    assert len(made) == 2


def test_where_no_cache_can_be_written_shapes_are_made(tmp_path, monkeypatch, made):
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    for _ in range(2):
        again(robot(tmp_path))
    assert len(made) == 2


def test_a_folder_that_may_not_be_looked_into_is_no_hindrance(tmp_path, monkeypatch, made):
    def refused(*_, **__):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(kept_shapes.np, "load", refused)
    monkeypatch.setattr(Path, "stat", refused)
    monkeypatch.setattr(Path, "mkdir", refused)
    box = shapes.trimesh.creation.box()
    monkeypatch.setattr(kept_shapes, "_path", lambda _: tmp_path / "kept.npz")

    class Bare:
        visual_meshes, mesh_warnings, visual_digest = {"base": box}, [], "x"

    assert shapes._robot_shape.__wrapped__(Bare()).links["base"]
    assert made


def test_what_the_kept_parts_depend_on_has_a_version():
    assert kept_shapes._path(load_robot()) == kept_shapes._path(load_robot())
