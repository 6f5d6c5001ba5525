"""Models of the error of a reading, by name."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Sampler = Callable[[NDArray[np.float64], np.random.Generator], NDArray[np.float64]]


@dataclass(frozen=True)
class NoiseModel:
    """How readings err.

    Attributes:
        name: as on the command line.
        text: what it does, in one clause.
        sample: takes true readings in metres and a generator, gives noisy readings.
    """

    name: str
    text: str
    sample: Sampler


def _paper(readings: NDArray[np.float64], rng: np.random.Generator) -> NDArray[np.float64]:
    """Errors of 8 to 11 % of the distance (paper, section III-B), taken as three sigma.

    As one sigma they would be far larger than what the paper's own results allow. Below 0.2 m the
    datasheet of the VL53L5CX gives 15 mm, at its 2.7 sigma.
    """
    bound = rng.uniform(0.08, 0.11, readings.shape)
    sigma = np.where(readings < 0.2, 0.015 / 2.7, bound / 3 * readings)
    return readings + sigma * rng.standard_normal(readings.shape)


def _none(readings: NDArray[np.float64], rng: np.random.Generator) -> NDArray[np.float64]:
    return readings


NOISE_MODELS = {
    model.name: model
    for model in (
        NoiseModel(
            "paper",
            "Gaussian, three sigma are 8 to 11 % of the distance, below 0.2 m 2.7 sigma are 15 mm",
            _paper,
        ),
        NoiseModel("none", "exact readings", _none),
    )
}
"""{name: model}."""
