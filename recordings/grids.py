"""Grids of zones: valid sizes, and padding of several sizes into one array."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

_LEAST, _MOST = 2, 64
SIZES = f"{_LEAST} x {_LEAST} to {_MOST} x {_MOST} zones"
"""Valid sizes of a sensor, for messages."""

Grid = tuple[int, int]
"""Rows and columns."""


def is_grid(rows: int, columns: int) -> bool:
    """Whether an image of this size can be of a ToF sensor, a zone per pixel."""
    return _LEAST <= rows <= _MOST and _LEAST <= columns <= _MOST


def size_text(grid: Grid) -> str:
    """Text of a size, columns first."""
    return f"{grid[1]} x {grid[0]}"


def common_grid(grids: Sequence[Grid]) -> Grid:
    """Smallest grid that contains all given ones."""
    return max(rows for rows, _ in grids), max(columns for _, columns in grids)


def padded(values: NDArray[Any], grid: Grid, filling: float) -> NDArray[Any]:
    """Pad values (rows, columns, ...) at the end to a grid at least as large."""
    rows, columns = values.shape[:2]
    if (rows, columns) == grid:
        return values
    wide = np.full((*grid, *values.shape[2:]), filling, dtype=values.dtype)
    wide[:rows, :columns] = values
    return wide
