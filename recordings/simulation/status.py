"""Simulation of the target status: dropouts and flying pixels."""

import numpy as np
from numpy.typing import NDArray

from recordings.simulation.edges import Edges, ZoneHits

VALID, NO_TARGET = 5, 255
# Ratio 37 : 3 : 0.8 of the codes of invalid readings, measured on the centre of a wooden panel.
_INVALID, _SHARES = (255, 4, 2), np.array([37.0, 3.0, 0.8]) / 40.8


def invalid_codes(shape: tuple[int, ...], rng: np.random.Generator) -> NDArray[np.uint8]:
    """Random codes of invalid readings, with the measured frequencies."""
    return rng.choice(np.array(_INVALID, dtype=np.uint8), shape, p=_SHARES)


class Dropouts:
    """Dropouts that persist over frames: a two-state Markov chain (valid, invalid) for each zone.

    Transition probabilities are measured on the centre of a wooden panel. Readings of other
    targets were valid 99.9 % of the time.

    Args:
        rng: stream of random numbers.
    """

    STAYS_VALID, COMES_BACK = 0.943, 0.038
    """Transition probabilities on surfaces that drop out: valid to valid, invalid to valid."""
    OTHERWISE = 0.999
    """Probability of being valid on other surfaces."""

    def __init__(self, rng: np.random.Generator) -> None:
        self._rng = rng
        self._valid: NDArray[np.bool_] | None = None

    def next(self, drops_out: NDArray[np.bool_]) -> NDArray[np.uint8]:
        """Status of the next frame.

        The first frame is drawn from the stationary distribution.

        Args:
            drops_out: (S, rows, columns) whether a zone sees a surface that drops out.
        """
        if self._valid is None:
            stationary = self.COMES_BACK / (self.COMES_BACK + 1.0 - self.STAYS_VALID)
            chance = np.where(drops_out, stationary, self.OTHERWISE)
        else:
            transition = np.where(self._valid, self.STAYS_VALID, self.COMES_BACK)
            chance = np.where(drops_out, transition, self.OTHERWISE)
        shape = drops_out.shape
        self._valid = self._rng.random(shape) < chance
        return np.where(self._valid, VALID, invalid_codes(shape, self._rng)).astype(np.uint8)


class FlyingPixels:
    """Flying pixels: readings of zones that look across a step.

    Measured at steps of more than 0.6 m: the zone on the step is valid 64 % of the time; of the
    valid readings 39 % are of the surface in front, 41 % of the one behind, 15 % between. The rest
    are of the surface that fills most of the zone.

    Args:
        rng: stream of random numbers.
    """

    VALID = 0.64
    FRONT, BEHIND, BETWEEN = 0.39, 0.41, 0.15

    def __init__(self, rng: np.random.Generator) -> None:
        self._rng = rng

    def next(self, seen: ZoneHits, edges: Edges) -> tuple[ZoneHits, NDArray[np.uint8]]:
        """Surfaces measured in the next frame, and their status, both (S, rows, columns).

        A reading between two surfaces belongs to the nearer one.
        """
        shape = seen.distance.shape
        outcome, where = self._rng.random(shape), self._rng.random(shape)
        valid = self._rng.random(shape) < self.VALID
        codes = invalid_codes(shape, self._rng)
        front = edges.step & (outcome < self.FRONT)
        behind = edges.step & ~front & (outcome < self.FRONT + self.BEHIND)
        between = (
            edges.step & ~front & ~behind & (outcome < self.FRONT + self.BEHIND + self.BETWEEN)
        )
        distance = np.where(front, edges.front.distance, seen.distance)
        distance = np.where(behind, edges.behind.distance, distance)
        gap = edges.behind.distance - edges.front.distance
        distance = np.where(between, edges.front.distance + where * gap, distance)
        piece = np.where(front | (between & (where < 0.5)), edges.front.piece, seen.piece)
        piece = np.where(behind | (between & (where >= 0.5)), edges.behind.piece, piece)
        status = np.where(edges.step & ~valid, codes, VALID).astype(np.uint8)
        return ZoneHits(distance, piece), status
