"""Short edges against all pairs."""

import numpy as np
import pytest

from estimator.engine.blocks import in_blocks
from estimator.engine.neighbours import neighbours
from estimator.engine.short_edges import short_edges
from tests.estimator.engine.clouds import KINDS, cloud_of


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("k", [2, 10])
def test_they_are_all_pairs_of_which_one_is_within_the_others_core_distance(kind, k):
    cloud = cloud_of(kind, np.random.default_rng(k), most=200)
    blocks, size = in_blocks(cloud), len(cloud)
    near = neighbours(blocks, k, size * size)
    edges = short_edges(blocks, near)
    points = blocks.points[:, :size]
    squared_core = near.squared_core[:size]
    x, y, z = points[:, :, None] - points[:, None, :]
    squared = (x * x + y * y) + z * z
    close = squared <= np.maximum(squared_core[:, None], squared_core[None, :])
    np.fill_diagonal(close, False)
    for i in range(size):
        own = blocks.number[i]
        found = edges.point[edges.begin[own] : edges.begin[own + 1]]
        assert sorted(found.tolist()) == sorted(blocks.number[np.flatnonzero(close[i])].tolist())
