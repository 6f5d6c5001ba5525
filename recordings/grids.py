"""Grids of zones: valid sizes, and padding to a common size."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

_MIN_SIZE, _MAX_SIZE = 2, 64
SIZES = f"{_MIN_SIZE} x {_MIN_SIZE} to {_MAX_SIZE} x {_MAX_SIZE} zones"
"""Valid sizes of a sensor, for messages."""

Grid = tuple[int, int]
"""Rows and columns."""


def is_grid(rows: int, columns: int) -> bool:
    """Whether an image of this size can be of a ToF sensor, a zone per pixel."""
    return _MIN_SIZE <= rows <= _MAX_SIZE and _MIN_SIZE <= columns <= _MAX_SIZE


def size_text(grid: Grid) -> str:
    """Size as text, columns first."""
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
