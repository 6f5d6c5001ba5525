"""Hierarchies and condensed trees of cases worked by hand."""

import numpy as np

from estimator.engine.condensed_tree import condensed_tree, hierarchy

# Points on a line, with a gap of 5 m after the third and one of 2 m before the last.
PLACES = np.array([0.0, 1.0, 2.0, 7.0, 8.0, 9.0, 11.0])


def tree(places: np.ndarray, min_cluster_size: int):
    ends = np.stack([np.arange(len(places) - 1), np.arange(1, len(places))], 1).astype(np.int32)
    weight = np.diff(places)
    merged = hierarchy(ends, weight, np.argsort(weight, kind="stable"))
    return merged, condensed_tree(merged, min_cluster_size)


def test_a_hierarchy_merges_from_the_shortest_edge_to_the_longest():
    merged, _ = tree(PLACES, 2)
    assert merged.distance.tolist() == [1.0, 1.0, 1.0, 1.0, 2.0, 5.0]
    assert merged.size.tolist() == [2, 3, 2, 3, 4, 7]
    assert merged.children.tolist() == [[0, 1], [7, 2], [3, 4], [9, 5], [10, 6], [8, 11]]


def test_two_clusters_leave_the_root_and_a_far_point_falls_out_of_one():
    _, found = tree(PLACES, 3)
    rows = list(zip(found.parent, found.child, found.density.round(3), found.size, strict=True))
    assert found.clusters == 3
    assert rows[:2] == [(7, 8, 0.2, 3), (7, 9, 0.2, 4)]
    assert {row for row in rows[2:] if row[0] == 8} == {(8, k, 1.0, 1) for k in (0, 1, 2)}
    assert {row for row in rows[2:] if row[0] == 9} == {
        (9, 6, 0.5, 1),
        *((9, k, 1.0, 1) for k in (3, 4, 5)),
    }


def test_without_a_split_every_point_leaves_the_root():
    _, found = tree(PLACES, 5)
    assert found.clusters == 1
    assert set(found.parent.tolist()) == {7}
    density = dict(zip(found.child.tolist(), found.density.tolist(), strict=True))
    assert density == {0: 0.2, 1: 0.2, 2: 0.2, 3: 0.2, 4: 0.2, 5: 0.2, 6: 0.2}


def test_points_on_one_place_leave_at_an_infinite_density():
    _, found = tree(np.zeros(4), 2)
    assert np.isinf(found.density).all()
