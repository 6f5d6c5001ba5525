import numpy as np

from recordings.grids import common_grid, is_grid, padded


def test_a_sensor_has_2_to_64_zones_a_side():
    assert is_grid(2, 64)
    assert is_grid(64, 2)
    assert not is_grid(1, 8)
    assert not is_grid(8, 65)


def test_smaller_grids_lie_in_the_first_rows_and_columns_of_the_common_one():
    grid = common_grid([(4, 8), (6, 2)])
    assert grid == (6, 8)
    wide = padded(np.ones((4, 2, 3)), grid, np.nan)
    assert wide.shape == (6, 8, 3)
    assert (wide[:4, :2] == 1).all()
    assert np.isfinite(wide).sum() == 4 * 2 * 3


def test_numbers_keep_their_kind():
    assert padded(np.zeros((2, 2), np.uint8), (3, 3), 255).dtype == np.uint8
