"""Core distances and neighbours against scikit-learn's tree and all distances."""

import numpy as np
import pytest
from sklearn.neighbors import KDTree

from estimator.engine.blocks import in_blocks
from estimator.engine.neighbours import neighbours
from tests.estimator.engine.clouds import KINDS, cloud_of


def core_distances(cloud: np.ndarray, k: int) -> np.ndarray:
    return KDTree(cloud).query(cloud, k=k)[0][:, -1]


def in_order_of_cloud(number: np.ndarray, squared_core: np.ndarray) -> np.ndarray:
    core = np.empty(len(number))
    core[number] = np.sqrt(squared_core[: len(number)])
    return core


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("k", [1, 2, 5, 20, 32, 33, 40])
def test_core_distances_are_scikit_learns(kind, k):
    rng = np.random.default_rng(k)
    for _ in range(5):
        cloud = cloud_of(kind, rng)
        blocks = in_blocks(cloud)
        most = min(k, len(cloud))
        found = neighbours(blocks, most, len(cloud) ** 2)
        core = in_order_of_cloud(blocks.number, found.squared_core)
        assert core.tolist() == core_distances(cloud, most).tolist()
        assert (found.squared_core[len(cloud) :] == np.inf).all()


@pytest.mark.parametrize("size", [1, 7, 8, 9, 63, 64, 65])
def test_all_points_may_be_asked_for(size):
    cloud = np.random.default_rng(size).normal(size=(size, 3))
    blocks = in_blocks(cloud)
    found = neighbours(blocks, size, size * size)
    core = in_order_of_cloud(blocks.number, found.squared_core)
    assert core.tolist() == core_distances(cloud, size).tolist()
    assert len(found.other) == size * (size - 1)


@pytest.mark.parametrize("kind", KINDS)
def test_rows_hold_all_within_the_core_distance(kind):
    cloud = cloud_of(kind, np.random.default_rng(3), most=200)
    blocks, size = in_blocks(cloud), len(cloud)
    found = neighbours(blocks, min(10, size), size * size)
    assert found.complete
    points = blocks.points[:, :size]
    for i in range(size):
        x, y, z = points - points[:, i, None]
        squared = (x * x + y * y) + z * z
        within = np.flatnonzero(squared <= found.squared_core[i])
        row = slice(found.begin[i], found.begin[i + 1])
        order = np.argsort(found.other[row])
        assert found.other[row][order].tolist() == within[within != i].tolist()
        assert found.squared[row][order].tolist() == squared[within[within != i]].tolist()


def test_without_room_for_the_rows_core_distances_are_right():
    cloud = np.ones((200, 3))
    cloud[::50] += np.arange(4)[:, None]
    blocks = in_blocks(cloud)
    found = neighbours(blocks, 5, 1000)
    assert not found.complete
    core = in_order_of_cloud(blocks.number, found.squared_core)
    assert core.tolist() == core_distances(cloud, 5).tolist()
