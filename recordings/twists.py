"""Rigid motions at an instant: fitted to the velocities of points, and followed over time."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import expm

from recordings.transforms import Transform

_LEAST_POINTS = 6
_LEVER = 0.01  # metres rms about an axis, below which points do not tell the turn about it


@dataclass(frozen=True)
class Twist:
    """How fast something moves and turns.

    Attributes:
        turn: (3,) rad/s.
        shift: (3,) m/s of what is at the origin of the fixed frame.
    """

    turn: NDArray[np.float64]
    shift: NDArray[np.float64]

    def velocity(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Velocity (N, 3) m/s of points (N, 3) metres."""
        return np.cross(self.turn, points) + self.shift

    def mean_with(self, other: "Twist") -> "Twist":
        """Half-way between two."""
        return Twist(0.5 * (self.turn + other.turn), 0.5 * (self.shift + other.shift))

    def motion(self, seconds: float) -> Transform:
        """What takes points (4, 4) to where they are later."""
        x, y, z = (self.turn * seconds).tolist()
        rate = np.zeros((4, 4))
        rate[:3, :3] = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]
        rate[:3, 3] = self.shift * seconds
        return np.asarray(expm(rate), dtype=np.float64)


def fitted_twist(points: NDArray[np.float64], velocity: NDArray[np.float64]) -> Twist:
    """The rigid motion that fits best, in least squares, to velocities (N, 3) of points (N, 3).

    Turns that the points cannot tell, being few or in a line, are taken to be none.
    """
    known = np.isfinite(points).all(axis=1) & np.isfinite(velocity).all(axis=1)
    points, velocity = points[known], velocity[known]
    if len(points) == 0:
        return Twist(np.zeros(3), np.zeros(3))
    middle, mean = points.mean(axis=0), velocity.mean(axis=0)
    turn = np.zeros(3)
    if len(points) >= _LEAST_POINTS:
        arms = points - middle
        inertia = (arms**2).sum() * np.eye(3) - arms.T @ arms
        moments, axes = np.linalg.eigh(inertia)
        told = moments > len(points) * _LEVER**2
        momentum = axes.T @ np.cross(arms, velocity - mean).sum(axis=0)
        turn = axes[:, told] @ (momentum[told] / moments[told])
    return Twist(turn, mean - np.cross(turn, middle))
