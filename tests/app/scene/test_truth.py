from dataclasses import replace

import numpy as np
import pytest

from app.analysis.estimates import Estimates
from app.scene.truth import object_corners
from estimator import Parameters
from recordings import ObjectMesh
from tests.app.fake_recordings import fake_opened

BOX = ObjectMesh(
    np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]], dtype=np.float32),
    np.array([[0, 1, 2]], dtype=np.uint32),
)


@pytest.fixture(scope="module")
def pair():
    return Estimates().pair(fake_opened(), 20, Parameters())


def test_corners_are_those_of_a_box_around_the_object_where_it_is(pair):
    T_fixed_object = np.eye(4)
    T_fixed_object[:3, :3] = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
    T_fixed_object[:3, 3] = [10, 20, 30]
    shown = replace(pair, object_poses={"body": T_fixed_object})
    corners = object_corners({"body": BOX}, shown)
    assert len(corners) == 8
    np.testing.assert_allclose(corners.min(axis=0), [8, 20, 30])
    np.testing.assert_allclose(corners.max(axis=0), [10, 21, 33])


def test_objects_without_a_pose_or_a_surface_have_none(pair):
    nowhere = replace(pair, object_poses={"body": np.full((4, 4), np.nan)})
    flat = ObjectMesh(np.zeros((0, 3), dtype=np.float32), np.zeros((0, 3), dtype=np.uint32))
    assert object_corners({"body": BOX}, pair).shape == (0, 3)
    assert object_corners({"body": BOX}, nowhere).shape == (0, 3)
    assert object_corners({"body": flat}, replace(pair, object_poses={"body": np.eye(4)})).size == 0
