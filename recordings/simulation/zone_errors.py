"""Systematic errors of sensors and zones, constant over a recording."""

import numpy as np
from numpy.typing import NDArray

_Shape = tuple[int, int, int]


class Bias:
    """Constant offset and scale error of each sensor.

    Against motion capture a VL53L5CX has a scale error of 0.5 % and an offset of some millimetres;
    the datasheet's accuracy allows for twice that.

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
    """Constant error of each zone: about 1 mm rms on a flat wall, up to 6 mm in the corners.

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
        """Errors (S, rows, columns) in metres, independent of the readings."""
        return self._error


def border_factors(shape: _Shape, rng: np.random.Generator) -> NDArray[np.float64]:
    """Noise of each zone (S, rows, columns) relative to the inner zones.

    As measured on static targets: 1.15 to 1.2 at the border, 1.33 to 1.47 at the corners.
    """
    border = np.ones(shape[1:], dtype=bool)
    border[1:-1, 1:-1] = False
    factors = np.where(border, rng.uniform(1.15, 1.20, shape), 1.0)
    return np.where(corners(shape[1:]), rng.uniform(1.33, 1.47, shape), factors)


def corners(shape: tuple[int, int]) -> NDArray[np.bool_]:
    """Mask (rows, columns) of the corner zones."""
    found = np.zeros(shape, dtype=bool)
    found[np.ix_([0, -1], [0, -1])] = True
    return found
