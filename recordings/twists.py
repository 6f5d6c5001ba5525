"""Twists: fitted to the velocities of points, and integrated over time."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from recordings.transforms import Transform

_LEAST_POINTS = 6
_LEVER = 0.01  # metres rms about an axis, below which the rotation about it is not observable


@dataclass(frozen=True)
class Twist:
    """Velocity and angular velocity of a rigid body.

    Attributes:
        angular: (3,) rad/s.
        linear: (3,) m/s of the body's point at the origin of the fixed frame.
    """

    angular: NDArray[np.float64]
    linear: NDArray[np.float64]

    @cached_property
    def rests(self) -> bool:
        """Whether it is zero."""
        return not (self.angular.any() or self.linear.any())

    def velocity(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Velocity (N, 3) m/s of points (N, 3) metres."""
        return np.cross(self.angular, points) + self.linear

    def mean_with(self, other: "Twist") -> "Twist":
        """Mean of two twists."""
        return Twist(0.5 * (self.angular + other.angular), 0.5 * (self.linear + other.linear))

    def motion(self, seconds: float) -> Transform:
        """Rigid motion (4, 4) of points over `seconds` at this twist."""
        from scipy.linalg import expm

        x, y, z = (self.angular * seconds).tolist()
        rate = np.zeros((4, 4))
        rate[:3, :3] = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]
        rate[:3, 3] = self.linear * seconds
        return np.asarray(expm(rate), dtype=np.float64)


def fitted_twist(points: NDArray[np.float64], velocity: NDArray[np.float64]) -> Twist:
    """Least-squares fit of a twist to velocities (N, 3) m/s of points (N, 3) metres.

    Rotations that are not observable, with few points or points in a line, are set to zero.
    """
    if not velocity.any():
        return Twist(np.zeros(3), np.zeros(3))
    known = np.isfinite(points).all(axis=1) & np.isfinite(velocity).all(axis=1)
    points, velocity = points[known], velocity[known]
    if len(points) == 0:
        return Twist(np.zeros(3), np.zeros(3))
    middle, mean = points.mean(axis=0), velocity.mean(axis=0)
    angular = np.zeros(3)
    if len(points) >= _LEAST_POINTS:
        arms = points - middle
        inertia = (arms**2).sum() * np.eye(3) - arms.T @ arms
        moments, axes = np.linalg.eigh(inertia)
        observable = moments > len(points) * _LEVER**2
        momentum = axes.T @ np.cross(arms, velocity - mean).sum(axis=0)
        angular = axes[:, observable] @ (momentum[observable] / moments[observable])
    return Twist(angular, mean - np.cross(angular, middle))
