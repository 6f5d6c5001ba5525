"""Largest value of any stretch of an array, in two look-ups."""

import numpy as np
from numpy.typing import NDArray

from estimator.engine.compiled import compiled


@compiled
def range_maxima(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Table (L, N) of the largest of the 1, 2, 4, 8 ... values from each place on."""
    size = len(values)
    levels = 1
    while 1 << levels <= size:
        levels += 1
    table = np.empty((levels, size))
    table[0] = values
    for level in range(1, levels):
        half = 1 << (level - 1)
        for i in range(size - 2 * half + 1):
            table[level, i] = max(table[level - 1, i], table[level - 1, i + half])
    return table


@compiled
def maximum_between(table: NDArray[np.float64], first: int, last: int) -> float:
    """Largest value after place `first` up to `last` > `first`."""
    level = 0
    while 2 << level <= last - first:
        level += 1
    return max(table[level, first + 1], table[level, last - (1 << level) + 1])
