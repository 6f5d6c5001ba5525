"""Points of a pair under a ray from the camera."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.analysis.pairs import Pair
from app.analysis.zones import Side, cloud_of

_ON, _NEAR = 0.008, 0.016
"""Largest distance between the pointer and a point that it is on, or near to, as a part of the
picture's height."""

_STANDING_BACK = 3.0
"""A point that stands back counts as farther from the pointer by this factor."""


@dataclass(frozen=True)
class Sight:
    """Ray from the camera through the pointer.

    Attributes:
        origin: (3,) metres, in the fixed frame.
        direction: (3,) unit vector.
        near: distance of the near plane, metres; what is nearer is not drawn.
        on: largest angle between the ray and a point that the pointer is on, rad.
        tolerance: likewise of a point that it is near to.
    """

    origin: NDArray[np.float64]
    direction: NDArray[np.float64]
    near: float
    on: float
    tolerance: float

    @classmethod
    def through(
        cls,
        origin: NDArray[np.float64],
        direction: NDArray[np.float64],
        near: float,
        fov: float,
    ) -> "Sight":
        """Sight of a camera with a vertical field of view in rad; `direction` of any length."""
        on, tolerance = np.arctan(2 * np.tan(fov / 2) * np.array([_ON, _NEAR])).tolist()
        return cls(origin, direction / np.linalg.norm(direction), near, on, tolerance)


@dataclass(frozen=True)
class PointHit:
    """Point near a ray.

    Attributes:
        side: the cloud.
        index: of the point in it.
        angle: between the ray and the point, rad.
    """

    side: Side
    index: int
    angle: float


@dataclass(frozen=True)
class DrawnPoints:
    """Which points of a cloud are drawn.

    Attributes:
        shown: (N,) whether a point is drawn.
        clear: (N,) whether it stands out of the others.
    """

    shown: NDArray[np.bool_]
    clear: NDArray[np.bool_]


def point_at(pair: Pair, drawn: Mapping[Side, DrawnPoints], sight: Sight) -> PointHit | None:
    """The point nearest to a ray, None if the ray misses all.

    Points that stand out come before small ones behind or in front of them.

    Args:
        pair: to search.
        drawn: {cloud: its drawn points}; clouds that are not in it are not searched.
        sight: the ray.
    """
    best: PointHit | None = None
    least = np.inf
    for side, points in drawn.items():
        cloud = cloud_of(pair, side)
        if cloud is None or not points.shown.any():
            continue
        offset = cloud.points - sight.origin
        depth = offset @ sight.direction
        aside = np.linalg.norm(offset - depth[:, None] * sight.direction, axis=1)
        angle = np.arctan2(aside, depth)
        angle[~points.shown | (depth < sight.near) | (angle > sight.tolerance)] = np.inf
        rank = np.where(points.clear, angle, _STANDING_BACK * angle)
        index = int(rank.argmin())
        if rank[index] < least:
            least, best = rank[index], PointHit(side, index, float(angle[index]))
    return best
