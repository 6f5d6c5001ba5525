"""Sensor model of the simulator: from true distances to reported ranges and status."""

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from recordings.simulation.edges import Edges, ZoneHits
from recordings.simulation.imperfections import Streams
from recordings.simulation.noise import NoiseModel
from recordings.simulation.status import NO_TARGET, VALID, Dropouts, FlyingPixels
from recordings.simulation.surface import Surface
from recordings.simulation.zone_errors import Bias, FixedPattern, border_factors, corners
from robot_assets import SensorModel

# Readings without a valid status were within 60 mm of the truth 91 % of the time.
_PLAUSIBLE, _IMPLAUSIBLE_ERROR = 0.91, (0.06, 0.50)


@dataclass(frozen=True)
class Report:
    """Readings of all sensors in one frame.

    Attributes:
        seen: the surfaces that were measured, without noise.
        ranges: (S, rows, columns) metres, NaN where nothing is reported; readings whose status is
            not valid are included, as real sensors report them.
        status: (S, rows, columns) ST's target status, None where it is not simulated.
    """

    seen: ZoneHits
    ranges: NDArray[np.float64]
    status: NDArray[np.uint8] | None

    @property
    def valid(self) -> NDArray[np.bool_]:
        """(S, rows, columns) whether a reading is valid."""
        reported = np.isfinite(self.ranges)
        return reported if self.status is None else reported & (self.status == VALID)


class Sensing:
    """Errors of the sensors of a recording, frame by frame.

    Args:
        sensors: number of sensors.
        model: of all of them.
        noise: model of the errors.
        imperfections: names of the enabled ones.
        rng: of the noise.
        streams: of the imperfections.
    """

    def __init__(
        self,
        sensors: int,
        model: SensorModel,
        noise: NoiseModel,
        imperfections: Collection[str],
        rng: np.random.Generator,
        streams: Streams,
    ) -> None:
        on = {*imperfections, *noise.includes}
        shape = (sensors, model.rows, model.columns)
        self._model, self._noise, self._rng = model, noise, rng
        self._corner = np.broadcast_to(corners(shape[1:]), shape)
        self._errors: list[Bias | FixedPattern] = []
        if "bias" in on:
            self._errors.append(Bias(shape, streams.of("bias")))
        if "fixed_pattern" in on:
            self._errors.append(FixedPattern(shape, streams.of("fixed_pattern")))
        self._factors = (
            border_factors(shape, streams.of("border_zones")) if "border_zones" in on else 1.0
        )
        self._dropouts = Dropouts(streams.of("dropouts")) if "dropouts" in on else None
        self._flying = FlyingPixels(streams.of("flying_pixels")) if "flying_pixels" in on else None
        self._implausible = streams.of("implausible")

    @property
    def needs_edges(self) -> bool:
        """Whether `report` needs the steps within zones."""
        return self._flying is not None

    def report(self, seen: ZoneHits, edges: Edges | None, surfaces: dict[int, Surface]) -> Report:
        """Simulate the readings of the next frame.

        Args:
            seen: surface hit by each zone.
            edges: steps within zones; required where `needs_edges`.
            surfaces: {index of a mesh: its surface}.
        """
        states: list[NDArray[np.uint8]] = []
        if self._flying and edges:
            seen, status = self._flying.next(seen, edges)
            states.append(status)
        hit = np.isfinite(seen.distance)
        true = np.where(hit, seen.distance, 0.0)
        reflectance, drops_out = _properties(seen.piece, surfaces)
        sigma = self._noise.sigma(true, reflectance, self._rng) * self._factors
        noisy = true + sigma * self._rng.standard_normal(true.shape) + self._noise.shift(true)
        for error in self._errors:
            noisy = noisy + error.error(true)
        if self._dropouts:
            states.append(self._dropouts.next(drops_out))
        reach = self._noise.reach(true, reflectance, self._corner)
        if np.isfinite(reach).any():
            states.append(np.where(true > reach, NO_TARGET, VALID).astype(np.uint8))
        status = _worst(states)
        if status is not None:
            noisy = noisy + np.where(status == VALID, 0.0, self._implausible_errors(true.shape))
        reported = hit & (noisy >= self._model.min_range) & (noisy <= self._model.max_range)
        if status is not None:
            status = np.where(reported, status, NO_TARGET).astype(np.uint8)
        return Report(seen, np.where(reported, noisy, np.nan), status)

    def _implausible_errors(self, shape: tuple[int, ...]) -> NDArray[np.float64]:
        """Errors in metres of readings that are not valid, zero for most."""
        rng = self._implausible
        size = rng.uniform(*_IMPLAUSIBLE_ERROR, shape) * rng.choice([-1.0, 1.0], shape)
        return np.where(rng.random(shape) < _PLAUSIBLE, 0.0, size)


def _properties(
    piece: NDArray[np.int64], surfaces: dict[int, Surface]
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Reflectance of the surface of each mesh index, and whether its readings drop out."""
    # The last row is for the index -1, of zones that hit nothing.
    rows = max(surfaces, default=0) + 2
    reflectance, drops_out = np.ones(rows), np.zeros(rows, dtype=bool)
    for index, surface in surfaces.items():
        reflectance[index], drops_out[index] = surface.reflectance, surface.drops_out
    return reflectance[piece], drops_out[piece]


def _worst(states: list[NDArray[np.uint8]]) -> NDArray[np.uint8] | None:
    """Per zone the first status that is not valid; None where the list is empty."""
    if not states:
        return None
    status = states[0]
    for other in states[1:]:
        status = np.where(status == VALID, other, status)
    return status
