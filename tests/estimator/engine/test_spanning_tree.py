"""The tree by blocks and sparse graphs against the one over all pairs."""

import numpy as np
import pytest
from sklearn.neighbors import KDTree

from estimator.engine.prim import dense_prim
from estimator.engine.spanning_tree import spanning_tree
from tests.estimator.engine.clouds import KINDS, cloud_of
from tests.estimator.engine.trees import as_lists


def check(cloud: np.ndarray, k: int) -> None:
    core = KDTree(cloud).query(cloud, k=k)[0][:, -1]
    assert as_lists(spanning_tree(cloud, k)) == as_lists(dense_prim(cloud.T.copy(), core))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("k", [1, 2, 5, 20])
def test_hard_clouds(kind, k):
    rng = np.random.default_rng(k)
    for _ in range(10):
        cloud = cloud_of(kind, rng)
        check(cloud, min(k, len(cloud)))


@pytest.mark.parametrize("islands", [2, 30, 99, 100, 101, 150])
@pytest.mark.parametrize("step", [0.0, 0.01])
def test_many_components(islands, step):
    rng = np.random.default_rng(islands)
    centres = np.repeat(rng.uniform(-20.0, 20.0, (islands, 3)), 12, axis=0)
    cloud = centres + rng.normal(size=centres.shape) * 0.02
    if step:
        cloud = np.round(cloud / step) * step
    cloud = cloud[rng.permutation(len(cloud))]
    for k in (2, 5, 12):
        check(cloud, k)


@pytest.mark.parametrize("shape", [(9, 9, 9), (40, 20, 1), (600, 1, 1)])
@pytest.mark.parametrize("shuffled", [False, True])
def test_lattices(shape, shuffled):
    cloud = np.stack(np.meshgrid(*map(np.arange, shape)), axis=-1).reshape(-1, 3) * 0.1
    if shuffled:
        cloud = cloud[np.random.default_rng(0).permutation(len(cloud))]
    for k in (1, 4, 20):
        check(cloud, k)


@pytest.mark.parametrize("size", [1, 2, 8, 9, 64, 65])
def test_few_points_and_all_of_them_neighbours(size):
    cloud = np.random.default_rng(size).normal(size=(size, 3))
    check(cloud, 1)
    check(cloud, size)
