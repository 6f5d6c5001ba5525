"""Initial camera pose: a slanted view of the sensors and their surroundings."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]

_LOWER = 0.82  # of half the picture's height, below which a legend lies
_MARGIN = 1.12  # of the picture, relative to what fills it
_SMALLEST = 0.15  # metres, smallest half extent of what fills the picture
_REACH = 0.9  # metres from the sensors' centre; points beyond are left out of the view
_AROUND = 0.08  # metres around a sensor that are seen with it
_OUTLIERS = 3  # percent of points at either end of an axis that a view may cut off


@dataclass(frozen=True)
class View:
    """Position and look-at point of a camera, (3,) each, metres, in the drawing's frame."""

    position: Vector
    look_at: Vector


def first_view(
    points: NDArray[np.float64],
    poses: NDArray[np.float64],
    R_drawing_fixed: Vector,
    fov: float,
    aspect: float,
    important: Vector | None = None,
) -> View:
    """View that contains the sensors and the points near them.

    Args:
        points: (N, 3) metres in the fixed frame.
        poses: (S, 4, 4) T_fixed_sensor, NaN where not known.
        R_drawing_fixed: (3, 3) from the fixed frame into one whose z axis points up.
        fov: vertical field of view of the camera, rad.
        aspect: width by height of the picture.
        important: points (M, 3) in the fixed frame, all of which the view contains, however far
            away; None for none.
    """
    poses = poses[np.isfinite(poses).all(axis=(1, 2))]
    sensors = poses[:, :3, 3] @ R_drawing_fixed.T
    seen = surroundings(points @ R_drawing_fixed.T, sensors)
    if important is not None:
        seen = np.vstack([seen, important @ R_drawing_fixed.T])
    direction = _towards_camera(poses[:, :3, 2] @ R_drawing_fixed.T)
    return filling_view(seen, direction, fov, aspect)


def filling_view(
    points: Vector, direction: Vector, fov: float, aspect: float, smallest: float = _SMALLEST
) -> View:
    """The nearest view in a direction whose picture contains all points, with a margin.

    Args:
        points: (N, 3) metres, N >= 1.
        direction: (3,) unit vector from what is seen to the camera.
        fov: vertical field of view of the camera, rad.
        aspect: width by height of the picture.
        smallest: half extent of what fills the picture at least, metres.
    """
    right = np.cross([0.0, 0.0, 1.0], direction)
    # Straight from above, x is to the right.
    right = right / np.linalg.norm(right) if np.any(right) else np.array([1.0, 0.0, 0.0])
    up = np.cross(direction, right)
    slope = np.tan(fov / 2) / _MARGIN
    depth = points @ direction
    middle = float(depth.min() + depth.max()) / 2
    sides, ends = (aspect * slope, aspect * slope), (slope, _LOWER * slope)
    away = max(
        _nearest(points @ right, depth, sides),
        _nearest(points @ up, depth, ends),
        middle + smallest / (slope * min(aspect, 1.0)),
    )
    centre = _middle(points @ right, depth, sides, away) * right
    centre += _middle(points @ up, depth, ends, away) * up
    return View(centre + away * direction, centre + middle * direction)


def _nearest(across: Vector, depth: Vector, slopes: tuple[float, float]) -> float:
    """Where along its gaze a camera must stand at least so that two edges hold all points.

    Each point must lie between both edges of the picture of a camera at (middle, place):
    across - middle <= slopes[0] * (place - depth) and middle - across <= slopes[1] * (...).

    Args:
        across: (N,) metres to one side.
        depth: (N,) metres towards the camera.
        slopes: of the rays through the edges at this side, and at the other.
    """
    one, other = slopes
    return float((across + one * depth).max() + (other * depth - across).max()) / (one + other)


def _middle(across: Vector, depth: Vector, slopes: tuple[float, float], place: float) -> float:
    """Where across its gaze a camera at a place stands with equal room at both edges."""
    one, other = slopes
    least, most = (across + one * depth).max(), (other * depth - across).max()
    return float((least - one * place) + (other * place - most)) / 2


def without_outliers(points: Vector) -> Vector:
    """Most of the points (N, 3): those far off along an axis are left out."""
    if len(points) == 0:
        return points
    low, high = np.percentile(points, [_OUTLIERS, 100 - _OUTLIERS], axis=0)
    return points[((points >= low) & (points <= high)).all(axis=1)]


def surroundings(points: Vector, sensors: Vector) -> Vector:
    """The sensors and most of the points near them, (M, 3), M >= 1.

    Args:
        points: (N, 3) metres.
        sensors: (S, 3) metres.
    """
    around = _AROUND * np.vstack([np.eye(3), -np.eye(3)])
    bodies = (sensors[:, None] + around).reshape(-1, 3)
    seen = np.vstack([bodies, without_outliers(_near(points, sensors))])
    return seen if len(seen) else np.zeros((1, 3))


def _near(points: Vector, sensors: Vector) -> Vector:
    """Points within `_REACH` of the sensors' centre, and a minimum share of them in any case.

    The share is small for several sensors, which see walls all around, and large for a single
    one, which is aimed at its subject.
    """
    if len(points) == 0 or len(sensors) == 0:
        return points
    distance = np.linalg.norm(points - sensors.mean(axis=0), axis=1)
    part = 0.1 if len(sensors) > 1 else 0.95
    return points[distance <= max(_REACH, float(np.quantile(distance, part)))]


def _towards_camera(looking: Vector) -> Vector:
    """Unit vector towards the camera: to the side of the mean viewing direction, behind, above."""
    forward = looking.mean(axis=0) * [1.0, 1.0, 0.0] if len(looking) else np.zeros(3)
    if np.linalg.norm(forward) < 0.3:
        forward = np.array([0.0, 1.0, 0.0])  # the directions of sensors all around cancel out
    forward = forward / np.linalg.norm(forward)
    up = np.array([0.0, 0.0, 1.0])
    direction = np.cross(forward, up) - 0.5 * forward + 0.45 * up
    return direction / np.linalg.norm(direction)
