"""Errors that a sensor or a zone has throughout a recording."""

import numpy as np
from numpy.typing import NDArray

_Shape = tuple[int, int, int]


class Bias:
    """Each sensor errs in a way of its own that does not change.

    Of a VL53L5CX against motion capture the scale is off by 0.5 % and the offset by some
    millimetres; the datasheet's accuracy leaves room for twice that.

    Args:
        shape: sensors, rows, columns.
        rng: stream of random numbers.
    """

    OFFSET, SCALE = 0.010, 0.01
    """One sigma over the sensors: metres, and share of the distance."""

    def __init__(self, shape: _Shape, rng: np.random.Generator) -> None:
        self._offset = self.OFFSET * rng.standard_normal((shape[0], 1, 1))
        self._scale = self.SCALE * rng.standard_normal((shape[0], 1, 1))

    def error(self, readings: NDArray[np.float64]) -> NDArray[np.float64]:
        """Errors (S, rows, columns) in metres of readings in metres."""
        return self._offset + self._scale * readings


class FixedPattern:
    """Each zone errs by a constant: about 1 mm rms on a flat wall, up to 6 mm in the corners.

    Args:
        shape: sensors, rows, columns.
        rng: stream of random numbers.
    """

    INNER, CORNER = 0.001, 0.003
    """One sigma over the zones, metres."""

    def __init__(self, shape: _Shape, rng: np.random.Generator) -> None:
        sigma = np.where(corners(shape[1:]), self.CORNER, self.INNER)
        self._error = sigma * rng.standard_normal(shape)

    def error(self, readings: NDArray[np.float64]) -> NDArray[np.float64]:
        """Errors (S, rows, columns) in metres, whatever the readings are."""
        return self._error


def border_factors(shape: _Shape, rng: np.random.Generator) -> NDArray[np.float64]:
    """How many times as large a zone's noise is, (S, rows, columns).

    As measured on static targets: at the border 1.15 to 1.2 times that of the inner zones, at the
    corners 1.33 to 1.47 times.
    """
    border = np.ones(shape[1:], dtype=bool)
    border[1:-1, 1:-1] = False
    factors = np.where(border, rng.uniform(1.15, 1.20, shape), 1.0)
    return np.where(corners(shape[1:]), rng.uniform(1.33, 1.47, shape), factors)


def corners(shape: tuple[int, int]) -> NDArray[np.bool_]:
    """Which of (rows, columns) zones are corners."""
    found = np.zeros(shape, dtype=bool)
    found[np.ix_([0, -1], [0, -1])] = True
    return found
