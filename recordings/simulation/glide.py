"""A pure translation along a path of straight pieces, between two rests."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

REST = 0.7
"""Seconds of rest before and after a motion: longer than the eight frames of the paper's pair."""


@dataclass(frozen=True)
class Glide:
    """Rest, then constant speed along the path, then rest.

    The speed jumps at both ends, as if the arm had no inertia: every frame of the motion has the
    commanded speed, and every stop is sharp.

    Attributes:
        pieces: (P, 3) metres, the displacements that are added one after the other.
        speed: m/s along the path.
    """

    pieces: NDArray[np.float64]
    speed: float

    def __post_init__(self) -> None:
        if not self.speed > 0:
            raise ValueError(f"A speed must be above 0 m/s, got {self.speed}.")

    @property
    def length(self) -> float:
        """Metres of the whole path."""
        return float(np.linalg.norm(self.pieces, axis=1).sum())

    @property
    def end(self) -> float:
        """Seconds at which the motion is over."""
        return REST + self.length / self.speed

    def moves(self, time: float) -> bool:
        """Whether it moves at `time`, seconds from the start of the recording."""
        return REST < time < self.end

    def travelled(self, time: float) -> float:
        """Metres along the path at `time`."""
        return float(np.clip((time - REST) * self.speed, 0.0, self.length))

    def displacement(self, travelled: float) -> NDArray[np.float64]:
        """Displacement (3,) in metres after so many metres of the path."""
        lengths = np.linalg.norm(self.pieces, axis=1)
        before = np.concatenate([[0.0], np.cumsum(lengths)[:-1]])
        shares = np.clip((travelled - before) / lengths, 0.0, 1.0)
        return shares @ self.pieces

    def velocity(self, time: float) -> NDArray[np.float64]:
        """Velocity (3,) in m/s at `time`, zero at rest."""
        if not self.moves(time):
            return np.zeros(3)
        ends = np.cumsum(np.linalg.norm(self.pieces, axis=1))
        piece = self.pieces[min(int(np.searchsorted(ends, self.travelled(time))), len(ends) - 1)]
        return self.speed * piece / np.linalg.norm(piece)
