"""Prim's algorithm, dense and sparse, against a plain one."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sklearn.neighbors import KDTree

from estimator.engine.longer_edges import edges_of
from estimator.engine.prim import Edges, dense_prim, sparse_prim
from tests.estimator.engine.clouds import KINDS, cloud_of
from tests.estimator.engine.trees import as_lists, lengths, no_edges, plain_prim


def all_edges(length: np.ndarray) -> Edges:
    first, second = np.triu_indices(len(length), 1)
    ends = np.stack([first, second], axis=1).astype(np.int32)
    return edges_of(len(length), ends, length[first, second])


def check(cloud: np.ndarray, core: np.ndarray) -> None:
    length = lengths(cloud, core)
    dense = as_lists(dense_prim(cloud.T.copy(), core))
    assert dense == plain_prim(length)
    assert as_lists(sparse_prim(core, no_edges(len(cloud)), all_edges(length))) == dense


@given(
    steps=st.lists(st.tuples(*[st.integers(0, 2)] * 3), min_size=1, max_size=27),
    k=st.integers(1, 6),
)
def test_lattices(steps, k):
    cloud = np.array(steps) * 0.1
    core = KDTree(cloud).query(cloud, k=min(k, len(cloud)))[0][:, -1]
    check(cloud, core)


@pytest.mark.parametrize("kind", KINDS)
def test_hard_clouds(kind):
    rng = np.random.default_rng(5)
    for _ in range(3):
        cloud = cloud_of(kind, rng, most=150)
        check(cloud, KDTree(cloud).query(cloud, k=min(5, len(cloud)))[0][:, -1])


def test_of_equal_edges_the_first_point_by_the_first_edge():
    square = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    tree = dense_prim(square.T.copy(), np.zeros(4))
    assert as_lists(tree) == ([0, 0, 1, 0], [0, 1, 2, 3], [np.inf, 1.0, 1.0, 1.0])


def test_short_edges_are_as_long_as_the_larger_core_distance():
    core = np.array([1.0, 3.0, 2.0])
    ring = edges_of(3, np.array([[0, 1], [1, 2], [0, 2]], np.int32), np.zeros(3))
    tree = sparse_prim(core, ring._replace(weight=np.empty(0)), no_edges(3))
    assert as_lists(tree) == ([0, 0, 0], [0, 2, 1], [np.inf, 2.0, 3.0])


def test_a_component_that_nothing_leads_to_begins_at_its_first_point():
    pairs = edges_of(5, np.array([[0, 3], [4, 2]], np.int32), np.array([0.5, 0.25]))
    tree = sparse_prim(np.zeros(5), no_edges(5), pairs)
    expected = [0, 0, 1, 2, 2], [0, 3, 1, 2, 4], [np.inf, 0.5, np.inf, np.inf, 0.25]
    assert as_lists(tree) == expected
