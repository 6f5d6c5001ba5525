"""Labels and probabilities of condensed trees worked by hand."""

import numpy as np
import pytest

from estimator.engine.labels import labels_of
from tests.estimator.engine.test_condensed_tree import PLACES, tree


def test_the_more_stable_clusters_are_chosen():
    _, found = tree(PLACES, 3)
    label, probability = labels_of(found, 7, False)
    assert label.tolist() == [0, 0, 0, 1, 1, 1, 1]
    # The last point left its cluster at half of the density at which the others did.
    assert probability.tolist() == [1, 1, 1, 1, 1, 1, 0.5]


@pytest.mark.parametrize(("single", "expected"), [(False, -1), (True, 0)])
def test_a_single_cluster_must_be_allowed(single, expected):
    _, found = tree(np.arange(6.0), 4)
    label, probability = labels_of(found, 6, single)
    assert set(label.tolist()) == {expected}
    assert set(probability.tolist()) == {0.0 if expected == -1 else 1.0}


def test_a_parent_that_is_more_stable_than_what_is_in_it_is_chosen():
    # Two groups with a gap of 1.1 m within an island that is 50 m from another.
    near = np.concatenate([np.arange(4), 4.1 + np.arange(4)])
    places = np.concatenate([near, 57.0 + np.arange(8)])
    _, found = tree(places, 4)
    label, _ = labels_of(found, len(places), False)
    assert found.clusters == 5
    assert label.tolist() == [0] * 8 + [1] * 8
