"""Grids of zones: the sizes that a sensor may have, and several sizes in one array."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

_LEAST, _MOST = 2, 64
SIZES = f"{_LEAST} x {_LEAST} to {_MOST} x {_MOST} zones"
"""The sizes that a sensor may have, for sentences."""

Grid = tuple[int, int]
"""Rows and columns."""


def is_grid(rows: int, columns: int) -> bool:
    """Whether an image of this size is one of a ToF sensor, a zone per pixel."""
    return _LEAST <= rows <= _MOST and _LEAST <= columns <= _MOST


def shown(grid: Grid) -> str:
    """A size as people say it, columns first."""
    return f"{grid[1]} x {grid[0]}"


def common_grid(grids: Sequence[Grid]) -> Grid:
    """The smallest grid that holds all of several."""
    return max(rows for rows, _ in grids), max(columns for _, columns in grids)


def padded(values: NDArray[Any], grid: Grid, filling: float) -> NDArray[Any]:
    """Values (rows, columns, ...) in a grid at least as large, from its first row and column on."""
    rows, columns = values.shape[:2]
    if (rows, columns) == grid:
        return values
    wide = np.full((*grid, *values.shape[2:]), filling, dtype=values.dtype)
    wide[:rows, :columns] = values
    return wide
