"""The target status of a reading, and why it is not valid."""

import numpy as np
from numpy.typing import NDArray

from recordings.simulation.edges import Edges, Seen

VALID, NO_TARGET = 5, 255
# Of readings that were not valid in the core of a wooden panel, 37 : 3 : 0.8.
_INVALID, _SHARES = (255, 4, 2), np.array([37.0, 3.0, 0.8]) / 40.8


def invalid_codes(shape: tuple[int, ...], rng: np.random.Generator) -> NDArray[np.uint8]:
    """Codes of readings that are not valid, as often as they were seen."""
    return rng.choice(np.array(_INVALID, dtype=np.uint8), shape, p=_SHARES)


class Dropouts:
    """Validity that persists: a chain of two states for each zone, by what the zone sees.

    Measured from frame to frame in the core of a wooden panel; targets that are easy for the
    sensor were valid 99.9 % of the time.

    Args:
        rng: stream of random numbers.
    """

    STAYS_VALID, COMES_BACK = 0.943, 0.038
    """Probabilities from frame to frame on hard surfaces: valid to valid, invalid to valid."""
    EASY = 0.999
    """Both of them on easy surfaces."""

    def __init__(self, rng: np.random.Generator) -> None:
        self._rng = rng
        self._valid: NDArray[np.bool_] | None = None

    def next(self, hard: NDArray[np.bool_]) -> NDArray[np.uint8]:
        """Status (S, rows, columns) of the next frame, where each zone sees a hard surface or not.

        The first frame has as many valid zones as there are in the long run.
        """
        if self._valid is None:
            settled = self.COMES_BACK / (self.COMES_BACK + 1.0 - self.STAYS_VALID)
            chance = np.where(hard, settled, self.EASY)
        else:
            on_hard = np.where(self._valid, self.STAYS_VALID, self.COMES_BACK)
            chance = np.where(hard, on_hard, self.EASY)
        self._valid = self._rng.random(hard.shape) < chance
        return np.where(self._valid, VALID, invalid_codes(hard.shape, self._rng)).astype(np.uint8)


class FlyingPixels:
    """What zones read that look across a step.

    Measured beside steps of more than 0.6 m: the middle zone is valid 64 % of the time; of those
    39 % read what is in front, 41 % what is behind, 15 % something between. The rest read what
    fills most of the zone.

    Args:
        rng: stream of random numbers.
    """

    VALID = 0.64
    FRONT, BEHIND, BETWEEN = 0.39, 0.41, 0.15

    def __init__(self, rng: np.random.Generator) -> None:
        self._rng = rng

    def next(self, seen: Seen, edges: Edges) -> tuple[Seen, NDArray[np.uint8]]:
        """What the zones read in the next frame, and its status, both (S, rows, columns).

        A reading between two surfaces is taken to be of the one that it is nearer to.
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
        return Seen(distance, piece), status
