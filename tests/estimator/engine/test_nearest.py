"""The grid's nearest two against all distances."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from estimator.engine.nearest import NONE, make_grid, nearest_two


@pytest.mark.parametrize(
    "extent", [(1, 1, 1), (1, 1, 0), (0, 2, 1), (1, 0, 0), (0, 0, 0), (1, 9, 3)]
)
@given(
    seed=st.integers(0, 10**6),
    size=st.integers(1, 60),
    radius=st.floats(1e-3, 5.0),
    further=st.floats(0.0, 5.0),
)
def test_nearest_and_bound_of_the_others(extent, seed, size, radius, further):
    rng = np.random.default_rng(seed)
    points = rng.uniform(-1.0, 1.0, (size, 3)) * extent
    grid, limit = make_grid(points), radius + further
    assert sorted(grid.row.tolist()) == list(range(size))
    assert grid.points.tolist() == points[grid.row].tolist()

    for x, y, z in rng.uniform(-2.0, 2.0, (5, 3)):
        nearest, distance, bound = nearest_two(grid, x, y, z, radius, limit)
        distances = np.linalg.norm(grid.points - (x, y, z), axis=1)
        if nearest == NONE:
            assert distance == np.inf
            assert distances.min() >= limit - 1e-12
            others = distances
        else:
            assert distance == pytest.approx(distances.min(), abs=1e-15)
            assert distance == pytest.approx(distances[nearest], abs=1e-15)
            assert distance <= limit
            others = np.delete(distances, nearest)
        assert bound <= limit
        assert (others >= bound - 1e-12).all()


def test_the_bound_is_the_second_where_that_is_near():
    grid = make_grid(np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 5.0, 0.0]]))
    nearest, distance, bound = nearest_two(grid, 0.25, 0.0, 0.0, 2.0, 2.0)
    assert (grid.row[nearest], distance, bound) == (0, 0.25, 0.75)


@pytest.mark.parametrize("width", [1e-320, 1e-200, 1e-90])
def test_points_closer_than_numbers_allow_share_a_cell(width):
    grid = make_grid(np.array([[0.0, 0.0, 0.0], [width, 0.0, 0.0], [0.0, width, 0.0]]))
    nearest, _, bound = nearest_two(grid, 0.0, 0.0, 1.0, 2.0, 2.0)
    assert nearest != NONE
    assert bound == 1.0
