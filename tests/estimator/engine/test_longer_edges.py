"""Edges that join components, and those that a spanning tree may have, against all pairs."""

import numpy as np
import pytest
from sklearn.neighbors import KDTree

from estimator.engine.blocks import in_blocks
from estimator.engine.longer_edges import components, edges_of, leaving_edges, longer_edges
from estimator.engine.neighbours import neighbours
from estimator.engine.prim import dense_prim, sparse_prim
from estimator.engine.short_edges import short_edges
from tests.estimator.engine.clouds import KINDS, cloud_of
from tests.estimator.engine.trees import lengths, no_edges, squared_distances

K = 3


def core_of(cloud: np.ndarray) -> np.ndarray:
    return KDTree(cloud).query(cloud, k=min(K, len(cloud)))[0][:, -1]


@pytest.mark.parametrize("kind", KINDS)
def test_the_shortest_edge_leaves_each_component_but_the_largest(kind):
    rng = np.random.default_rng(7)
    for _ in range(5):
        cloud = cloud_of(kind, rng, most=150)
        size, core = len(cloud), core_of(cloud)
        blocks = in_blocks(cloud)
        near = neighbours(blocks, min(K, size), size * size)
        component = components(sparse_prim(core, short_edges(blocks, near), no_edges(size)))
        ends, weight = leaving_edges(blocks, near.squared_core, component)

        length = lengths(cloud, core)
        sizes = np.bincount(component)
        smaller = np.flatnonzero(np.arange(len(sizes)) != np.argmax(sizes))
        assert len(weight) == len(sizes) - 1 == len(smaller)
        left = component[ends]
        assert (left[:, 0] != left[:, 1]).all()
        # Every component is left once, at the end that is listed first.
        assert len(set(left[:, 0].tolist())) == len(weight)
        for (one, other), own, metres in zip(ends, left[:, 0], weight, strict=True):
            leaving = length[component == own][:, component != own]
            assert metres == leaving.min() == length[one, other]


@pytest.mark.parametrize("kind", KINDS)
def test_all_edges_that_no_path_of_shorter_ones_replaces(kind):
    rng = np.random.default_rng(8)
    for _ in range(5):
        cloud = cloud_of(kind, rng, most=100)
        size, core = len(cloud), core_of(cloud)
        blocks = in_blocks(cloud)
        near = neighbours(blocks, min(K, size), size * size)
        tree = dense_prim(cloud.T.copy(), core)
        ends, weight, complete = longer_edges(blocks, near.squared_core, tree, size * size)
        assert complete
        found = {tuple(sorted(pair)): w for pair, w in zip(ends.tolist(), weight, strict=True)}
        assert len(found) == len(weight), "each pair once"

        length, step = lengths(cloud, core), np.argsort(tree.point)
        # The squares tell which are short: roots of two of them may be rounded to one length.
        squared, squared_core = (
            squared_distances(cloud),
            near.squared_core[np.argsort(blocks.number)],
        )
        for i in range(size):
            for j in range(i + 1, size):
                first, last = sorted((step[i], step[j]))
                short = squared[i, j] <= max(squared_core[i], squared_core[j])
                wanted = not short and length[i, j] <= tree.weight[first + 1 : last + 1].max()
                assert ((i, j) in found) == wanted
                if wanted:
                    assert found[i, j] == length[i, j]


def test_without_room_it_says_so():
    cloud = np.random.default_rng(0).normal(size=(100, 3))
    core = np.zeros(100)
    tree = dense_prim(cloud.T.copy(), core)
    blocks = in_blocks(cloud)
    zeros = np.zeros(blocks.points.shape[1])
    assert longer_edges(blocks, zeros, tree, 99)[2]
    assert not longer_edges(blocks, zeros, tree, 98)[2]


def test_edges_are_in_the_rows_of_both_ends():
    edges = edges_of(4, np.array([[2, 0], [0, 3]], np.int32), np.array([0.5, 0.25]))
    assert edges.begin.tolist() == [0, 2, 2, 3, 4]
    assert edges.point.tolist() == [2, 3, 0, 0]
    assert edges.weight.tolist() == [0.5, 0.25, 0.5, 0.25]
