import numpy as np
import pytest
import trimesh

from app.scene.shapes import coarse, ring_through, robot_shape
from robot_assets import load_robot


def test_the_pandas_shape_is_light_coloured_and_complete():
    robot = load_robot()
    shape = robot_shape(robot)
    assert set(shape.links) == set(robot.visual_meshes)
    parts = [part for parts in shape.links.values() for part in parts]
    size = sum(part.vertices.nbytes + part.faces.nbytes for part in parts)
    assert size < 2e6  # half of the faces
    assert len({part.colour for part in parts}) > 3
    for link, mesh in robot.visual_meshes.items():
        assert sum(len(part.faces) for part in shape.links[link]) >= 0.49 * len(mesh.faces)
        points = np.vstack([part.vertices for part in shape.links[link]])
        np.testing.assert_allclose([points.min(0), points.max(0)], mesh.bounds, atol=1e-3)


def test_equal_robots_have_equal_digests():
    assert robot_shape(load_robot()).digest == robot_shape(load_robot()).digest


def test_sharp_edges_stay_sharp():
    urdf = (
        '<robot name="box"><link name="base"><visual><geometry><box size="1 1 1"/></geometry>'
        "</visual></link></robot>"
    )
    (part,) = robot_shape(load_robot(urdf)).links["base"]
    # A cube that were shaded smoothly would have 8 vertices.
    assert len(part.vertices) == 24


def test_the_band_passes_close_to_the_points_of_a_tilted_circle():
    angles = np.linspace(0, 2 * np.pi, 8, endpoint=False)
    tilt = trimesh.transformations.rotation_matrix(0.7, [1, 2, 0])[:3, :3]
    centre = np.array([0.3, -0.2, 0.5])
    points = centre + 0.1 * np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1) @ tilt.T
    band = ring_through(points)
    assert band is not None
    distance = np.linalg.norm(band.vertices[None] - points[:, None], axis=2).min(axis=1)
    assert distance.max() < 0.006
    np.testing.assert_allclose(band.bounds.mean(axis=0), centre, atol=1e-3)


def test_two_points_make_no_band():
    assert ring_through(np.zeros((2, 3))) is None


def test_a_coarse_surface_has_fewer_triangles_on_the_same_place():
    ball = trimesh.creation.icosphere(5, 0.5)
    vertices, faces = coarse(ball.vertices.astype(np.float32), ball.faces.astype(np.uint32), 0.1)
    assert 100 < len(faces) < len(ball.faces) / 10
    assert faces.max() < len(vertices)
    np.testing.assert_allclose(np.linalg.norm(vertices, axis=1), 0.5, atol=0.02)
    volume = trimesh.Trimesh(vertices, faces).volume
    assert volume == pytest.approx(ball.volume, rel=0.06)
