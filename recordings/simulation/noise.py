"""Noise models of a reading, by name."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from recordings.simulation.datasheet import BRIGHT, DARK, AmbientLight

Values = NDArray[np.float64]


def _nothing(readings: Values) -> Values:
    return np.zeros_like(readings)


def _everywhere(readings: Values, reflectance: Values, corner: NDArray[np.bool_]) -> Values:
    return np.full(readings.shape, np.inf)


@dataclass(frozen=True)
class NoiseModel:
    """Model of the errors of readings.

    Attributes:
        name: as on the command line.
        text: description in one clause; it is stored in recordings.
        sigma: (true readings in metres, reflectances, generator) -> standard deviation of the
            Gaussian noise in metres.
        shift: true readings in metres -> systematic error in metres.
        reach: (true readings in metres, reflectances, whether of corner zones) -> maximum range
            in metres.
        includes: names of the imperfections that are part of it.
    """

    name: str
    text: str
    sigma: Callable[[Values, Values, np.random.Generator], Values]
    shift: Callable[[Values], Values] = _nothing
    reach: Callable[[Values, Values, NDArray[np.bool_]], Values] = _everywhere
    includes: tuple[str, ...] = ()


def _paper(readings: Values, reflectance: Values, rng: np.random.Generator) -> Values:
    """Errors of 8 to 11 % of the distance (paper, section III-B), taken as three sigma.

    As one sigma they would be far too large for the paper's own results. Below 0.2 m the datasheet
    of the VL53L5CX gives 15 mm at 2.7 sigma.
    """
    bound = rng.uniform(0.08, 0.11, readings.shape)
    return np.where(readings < 0.2, 0.015 / 2.7, bound / 3 * readings)


def _measured(readings: Values, reflectance: Values, rng: np.random.Generator) -> Values:
    """Fit to a zone of a VL53L5CX on a parked drone, 15 Hz: 0.65 mm at 0.025 m, 15 mm at 2.16 m."""
    return 0.0005 + 0.006 * readings


def _measured_shift(readings: Values) -> Values:
    """Scale error of the same sensors, -0.5 %, and 6 mm too far below 0.3 m."""
    return -0.005 * readings + np.where(readings < 0.3, 0.006, 0.0)


def _none(readings: Values, reflectance: Values, rng: np.random.Generator) -> Values:
    return np.zeros_like(readings)


def _datasheet(name: str, text: str, light: AmbientLight) -> NoiseModel:
    return NoiseModel(
        name,
        text,
        sigma=lambda readings, reflectance, rng: light.sigma(readings, reflectance),
        reach=lambda readings, reflectance, corner: light.reach(reflectance, corner),
    )


NOISE_MODELS = {
    model.name: model
    for model in (
        NoiseModel(
            "paper",
            "Gaussian, three sigma are 8 to 11 % of the distance, below 0.2 m 2.7 sigma are 15 mm",
            _paper,
        ),
        _datasheet(
            "datasheet",
            "Gaussian, 2.7 sigma are 5 % of the distance, below 0.2 m 15 mm; white is seen up to "
            "3.5 m, grey up to 1.3 m (VL53L5CX datasheet, in the dark)",
            DARK,
        ),
        _datasheet(
            "datasheet_bright",
            "Gaussian, 2.7 sigma are 8 % of the distance on white and 11 % on grey, below 0.2 m "
            "15 mm; white is seen up to 1.1 m, grey up to 0.8 m (VL53L5CX datasheet, 5 klux)",
            BRIGHT,
        ),
        NoiseModel(
            "measured",
            "as measured on real sensors: Gaussian of 0.5 mm and 0.6 % of the distance, scale off "
            "by -0.5 %, 6 mm more below 0.3 m, with border_zones, fixed_pattern, dropouts and "
            "flying_pixels",
            _measured,
            shift=_measured_shift,
            includes=("border_zones", "fixed_pattern", "dropouts", "flying_pixels"),
        ),
        NoiseModel("none", "exact readings", _none),
    )
}
"""{name: model}."""
