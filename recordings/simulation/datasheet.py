"""Accuracy and range of the VL53L5CX from its datasheet, interpolated over the reflectance.

DS13754 Rev 2 (STMicroelectronics, August 2021), 8 x 8 zones, 15 Hz, continuous mode: the tables of
ranging accuracy (at 2.7 sigma, 99.3 % of readings) and of maximum ranging distance (typical).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

_WHITE, _GREY = 0.88, 0.17  # reflectances of the datasheet's targets
_SIGMAS = 2.7
_NEAR, _NEAR_ERROR = 0.2, 0.015  # metres; below _NEAR the error is constant


@dataclass(frozen=True)
class AmbientLight:
    """Accuracy and range in one ambient light; each value is a pair (on white, on grey).

    Attributes:
        error: relative to the distance, for distances from 0.2 m.
        inner: maximum range of the inner zones, metres.
        corner: maximum range of the corner zones, metres.
    """

    error: tuple[float, float]
    inner: tuple[float, float]
    corner: tuple[float, float]

    def sigma(
        self, readings: NDArray[np.float64], reflectance: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Standard deviation in metres of readings in metres."""
        share = _interpolated(self.error, reflectance)
        return np.where(readings < _NEAR, _NEAR_ERROR, share * readings) / _SIGMAS

    def reach(
        self, reflectance: NDArray[np.float64], corner: NDArray[np.bool_]
    ) -> NDArray[np.float64]:
        """Maximum range in metres.

        Args:
            reflectance: of the surface that a zone sees.
            corner: whether it is a corner zone.
        """
        return np.where(
            corner, _interpolated(self.corner, reflectance), _interpolated(self.inner, reflectance)
        )


DARK = AmbientLight(error=(0.05, 0.05), inner=(3.5, 1.3), corner=(3.1, 1.1))
BRIGHT = AmbientLight(error=(0.08, 0.11), inner=(1.1, 0.8), corner=(1.0, 0.65))
"""5 klux."""


def _interpolated(
    values: tuple[float, float], reflectance: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Interpolate the values on white and on grey by a power law of the reflectance."""
    white, grey = values
    power = np.log(white / grey) / np.log(_WHITE / _GREY)
    return white * (reflectance / _WHITE) ** power
