"""Rays against shapes whose intersections are known."""

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from robot_assets import RayCaster

BOX = RayCaster(trimesh.creation.box((2, 4, 6)))
HALF = np.array([1.0, 2.0, 3.0])


def cast(caster: RayCaster, origin: tuple[float, ...], direction: tuple[float, ...]) -> float:
    unit = np.array([direction], dtype=float) / np.linalg.norm(direction)
    distance, _ = caster.cast(np.array([origin], dtype=float), unit)
    return float(distance[0])


def box_distance(origin: np.ndarray, direction: np.ndarray) -> float:
    """Distance at which a ray from outside enters the box (slab method), inf for a miss."""
    with np.errstate(divide="ignore", over="ignore"):
        bounds = np.stack([(-HALF - origin) / direction, (HALF - origin) / direction])
    enter, leave = bounds.min(axis=0).max(), bounds.max(axis=0).min()
    return enter if 0 <= enter < leave else np.inf


@pytest.mark.parametrize("axis", range(3))
@pytest.mark.parametrize("sign", [-1, 1])
def test_a_box_along_its_axes(axis, sign):
    origin, direction = np.full(3, 0.1), np.zeros(3)
    origin[axis], direction[axis] = -5.0 * sign, sign
    assert cast(BOX, tuple(origin), tuple(direction)) == pytest.approx(5 - HALF[axis], abs=1e-6)
    assert cast(BOX, tuple(origin), tuple(-direction)) == np.inf


UNIT = st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda v: np.linalg.norm(v) > 0.1)


@given(outward=UNIT, aim=st.tuples(*[st.floats(-3.5, 3.5)] * 3))
def test_a_box_from_anywhere_outside(outward, aim):
    origin = 6.0 * np.array(outward) / np.linalg.norm(outward)
    direction = (np.array(aim) - origin) / np.linalg.norm(np.array(aim) - origin)
    expected = box_distance(origin, direction)
    # A ray along an edge may fall to either side in single precision.
    shifted = [box_distance(origin + offset, direction) for offset in 1e-4 * np.eye(3)]
    shifted += [box_distance(origin - offset, direction) for offset in 1e-4 * np.eye(3)]
    if all(np.isfinite(s) == np.isfinite(expected) for s in shifted):
        assert cast(BOX, tuple(origin), tuple(direction)) == pytest.approx(expected, abs=1e-5)


def test_a_sphere():
    caster = RayCaster(trimesh.creation.icosphere(subdivisions=5, radius=1.0))
    rng = np.random.default_rng(0)
    outward = rng.normal(size=(200, 3))
    origins = 3.0 * outward / np.linalg.norm(outward, axis=1, keepdims=True)
    aim = rng.uniform(-0.5, 0.5, (200, 3))
    directions = (aim - origins) / np.linalg.norm(aim - origins, axis=1, keepdims=True)
    along = np.einsum("ij,ij->i", origins, directions)
    expected = -along - np.sqrt(along**2 - 8.0)

    distance, triangle = caster.cast(origins, directions)
    assert distance == pytest.approx(expected, abs=2e-3), "the facets lie within 1 mm of the sphere"
    assert (triangle >= 0).all()


def joined(*meshes: trimesh.Trimesh) -> trimesh.Trimesh:
    return trimesh.util.concatenate(list(meshes))  # type: ignore[return-value]


def plane(z: float, facing: int) -> trimesh.Trimesh:
    corners = [(-9, -9, z), (9, -9, z), (9, 9, z), (-9, 9, z)]
    faces = np.array([(0, 1, 2), (0, 2, 3)])
    return trimesh.Trimesh(corners, faces if facing > 0 else faces[:, ::-1], process=False)


@given(
    height=st.floats(0.02, 8.0),
    slope=st.tuples(st.floats(-0.9, 0.9), st.floats(-0.9, 0.9)),
    place=st.tuples(st.floats(-1, 1), st.floats(-1, 1)),
)
def test_a_plane_at_any_angle(height, slope, place):
    direction = np.array([*slope, -1.0])
    expected = height * np.linalg.norm(direction)
    found = cast(RayCaster(plane(0.0, 1)), (*place, height), tuple(direction))
    assert found == pytest.approx(expected, abs=1e-6)


def test_a_surface_from_behind_is_passed_through():
    both = joined(plane(1.0, 1), plane(3.0, -1))
    assert cast(RayCaster(both), (0, 0, 0), (0, 0, 1)) == pytest.approx(3.0, abs=1e-6)
    assert cast(RayCaster(plane(1.0, 1)), (0, 0, 0), (0, 0, 1)) == np.inf


def test_from_inside_a_mesh_only_other_meshes_are_met():
    around = trimesh.creation.box((1, 1, 1))
    other = trimesh.creation.box((1, 1, 1)).apply_translation((3, 0, 0))
    caster = RayCaster(joined(around, other))
    assert cast(caster, (0, 0, 0), (1, 0, 0)) == pytest.approx(2.5, abs=1e-6)
    assert cast(caster, (0, 0, 0), (0, 1, 0)) == np.inf


def test_overlapping_meshes_around_the_start_are_all_left():
    around = [trimesh.creation.box((s, s, s)) for s in (1.0, 1.2, 1.4)]
    wall = trimesh.creation.box((1, 9, 9)).apply_translation((3, 0, 0))
    caster = RayCaster(joined(*around, wall))
    assert cast(caster, (0, 0, 0), (1, 0, 0)) == pytest.approx(2.5, abs=1e-5)


def test_the_triangle_is_the_one_that_is_met():
    mesh = trimesh.creation.box((2, 2, 2))
    origins = np.array([(5.0, 0.1, 0.2), (0.1, -5.0, 0.2), (5.0, 5.0, 5.0)])
    directions = np.array([(-1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)])
    distance, triangle = RayCaster(mesh).cast(origins, directions)
    assert np.asarray(mesh.face_normals)[triangle[:2]].round(9).tolist() == [[1, 0, 0], [0, -1, 0]]
    assert triangle[2] == -1
    assert distance == pytest.approx([4.0, 4.0, np.inf], abs=1e-6)


def test_no_rays():
    distance, triangle = BOX.cast(np.zeros((0, 3)), np.zeros((0, 3)))
    assert distance.shape == triangle.shape == (0,)


def test_the_rays_are_left_as_they_were():
    origins, directions = np.array([(-5.0, 0.1, 0.1)]), np.array([(1.0, 0.0, 0.0)])
    BOX.cast(origins, directions)
    assert origins.tolist() == [[-5.0, 0.1, 0.1]]
    assert directions.tolist() == [[1.0, 0.0, 0.0]]


def test_thousands_of_meshes_in_a_process():
    mesh, origin, direction = plane(0.0, 1), np.array([[0.0, 0.0, 2.0]]), np.array([[0.0, 0, -1]])
    casters = [RayCaster(mesh) for _ in range(1500)]
    assert all(caster.cast(origin, direction)[0] == pytest.approx(2.0) for caster in casters)
