"""Translation along a polyline, with a rest before and after."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

REST = 0.7
"""Seconds of rest before and after a motion, longer than the paper's n = 8 frames."""


@dataclass(frozen=True)
class Trajectory:
    """Rest, then constant speed along a polyline, then rest.

    Without ramps the speed jumps at both ends, as if the arm had no inertia, and every frame of
    the motion has the commanded speed.

    Attributes:
        segments: (P, 3) metres, displacements along the polyline's segments.
        speed: m/s along the path.
        ramp: seconds of constant acceleration from rest to the speed, and of deceleration; on a
            path that is too short for both, the acceleration is the same and the speed lower.
    """

    segments: NDArray[np.float64]
    speed: float
    ramp: float = 0.0

    def __post_init__(self) -> None:
        if not self.speed > 0:
            raise ValueError(f"A speed must be above 0 m/s, got {self.speed}.")

    @cached_property
    def length(self) -> float:
        """Length of the path in metres."""
        return float(np.linalg.norm(self.segments, axis=1).sum())

    @cached_property
    def _share(self) -> float:
        """Share of the ramp, and so of the speed, that the length of the path allows."""
        if self.length >= self.speed * self.ramp:
            return 1.0
        return float(np.sqrt(self.length / (self.speed * self.ramp)))

    @property
    def end(self) -> float:
        """Seconds at which the motion ends."""
        return REST + self.length / (self._share * self.speed) + self._share * self.ramp

    def moves(self, time: float) -> bool:
        """Whether it moves at `time`, seconds from the start of the recording."""
        return REST < time < self.end

    def speed_at(self, time: float) -> float:
        """Speed in m/s along the path at `time`, 0 at rest."""
        if not self.moves(time):
            return 0.0
        if self.ramp == 0.0:
            return self.speed
        return self.speed * min((time - REST) / self.ramp, (self.end - time) / self.ramp, 1.0)

    def travelled(self, time: float) -> float:
        """Metres along the path at `time`."""
        if self.ramp == 0.0:
            return float(np.clip((time - REST) * self.speed, 0.0, self.length))
        gone, left = max(time - REST, 0.0), max(self.end - time, 0.0)
        ramp, acceleration = self._share * self.ramp, self.speed / self.ramp
        if gone <= ramp:
            return 0.5 * acceleration * gone**2
        if left <= ramp:
            return self.length - 0.5 * acceleration * left**2
        return self.speed * (gone - 0.5 * ramp)

    def displacement(self, travelled: float) -> NDArray[np.float64]:
        """Displacement (3,) in metres after `travelled` metres of the path."""
        lengths = np.linalg.norm(self.segments, axis=1)
        before = np.concatenate([[0.0], np.cumsum(lengths)[:-1]])
        shares = np.clip((travelled - before) / lengths, 0.0, 1.0)
        return shares @ self.segments

    def velocity(self, time: float) -> NDArray[np.float64]:
        """Velocity (3,) in m/s at `time`, zero at rest."""
        if not self.moves(time):
            return np.zeros(3)
        ends = np.cumsum(np.linalg.norm(self.segments, axis=1))
        piece = self.segments[min(int(np.searchsorted(ends, self.travelled(time))), len(ends) - 1)]
        return self.speed_at(time) * piece / np.linalg.norm(piece)
