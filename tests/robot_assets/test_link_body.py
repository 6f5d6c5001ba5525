"""Rays that a body stops are those that meet its mesh; the ball and the box only save time."""

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from robot_assets import RayCaster
from robot_assets.link_body import LinkBody, can_be_seen

PLATE = trimesh.Trimesh([(0, 0, 0), (1, 0, 0), (1, 1, 0)], [(0, 1, 2)])  # open, without thickness
MESHES = {
    "box": trimesh.creation.box((0.2, 0.3, 1.0)),
    "ball": trimesh.creation.icosphere(radius=0.4).apply_translation((0.5, 0, 0)),
    "plate": PLATE,
}


@given(st.integers(0, 10**6), st.sampled_from(sorted(MESHES)), st.booleans())
def test_rays_are_stopped_where_they_meet_the_mesh_within_their_reach(seed, name, along_axes):
    rng = np.random.default_rng(seed)
    origins = rng.uniform(-1.5, 1.5, (6, 3))
    directions = rng.normal(size=(6, 3, 50))
    if along_axes:
        directions = np.moveaxis(np.eye(3)[rng.integers(3, size=(6, 50))], 2, 1)
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    reach = np.where(rng.random((6, 50)) < 0.1, np.nan, rng.uniform(-0.1, 3.0, (6, 50)))

    rays = np.moveaxis(directions, 1, 2).reshape(-1, 3)
    distance, _ = RayCaster(MESHES[name]).cast(np.repeat(origins, 50, axis=0), rays)
    stopped = LinkBody(MESHES[name]).stops(origins, directions, reach)
    assert (stopped == (distance.reshape(6, 50) <= reach)).all()


def test_a_ray_out_of_the_mesh_that_it_starts_in_is_free():
    out = LinkBody(MESHES["box"]).stops(np.zeros((1, 3)), np.eye(3)[None], np.full((1, 3), 9.0))
    assert not out.any()


@pytest.mark.parametrize("name", MESHES)
def test_the_ball_holds_the_mesh(name):
    body = LinkBody(MESHES[name])
    apart = np.linalg.norm(MESHES[name].vertices - body.centre, axis=1)
    assert body.radius - 1e-3 < apart.max() < body.radius


def test_what_has_no_extent_cannot_be_seen():
    assert can_be_seen(PLATE)
    assert not can_be_seen(trimesh.Trimesh())
    assert not can_be_seen(trimesh.Trimesh(np.ones((3, 3)), [(0, 1, 2)], process=False))
