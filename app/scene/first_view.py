"""Initial camera pose: a slanted view of the sensors and their surroundings."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]

_SMALLEST = 0.15  # metres, smallest half extent of the box that fills the picture
_REACH = 0.9  # metres from the sensors' centre; points beyond are left out of the view


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
    important: Sequence[Vector] = (),
) -> View:
    """View that contains the sensors and the points near them.

    Args:
        points: (N, 3) metres in the fixed frame.
        poses: (S, 4, 4) T_fixed_sensor, NaN where not known.
        R_drawing_fixed: (3, 3) from the fixed frame into one whose z axis points up.
        fov: vertical field of view of the camera, rad.
        aspect: width by height of the picture.
        important: sets of points (M, 3) in the fixed frame; the view contains most of each, however
            far away.
    """
    poses = poses[np.isfinite(poses).all(axis=(1, 2))]
    sensors = poses[:, :3, 3] @ R_drawing_fixed.T
    box = [*near_corners(points @ R_drawing_fixed.T, sensors)]
    for seen in important:
        box += [*percentile_corners(seen @ R_drawing_fixed.T)]
    low, high = np.min(box, axis=0), np.max(box, axis=0)
    centre, half = (low + high) / 2, np.maximum((high - low) / 2, _SMALLEST)
    direction = _towards_camera(poses[:, :3, 2] @ R_drawing_fixed.T)
    distance = box_distance(half, direction, np.tan(fov / 2), aspect)
    return View(centre + distance * direction, centre)


def box_distance(half: Vector, direction: Vector, slope: float, aspect: float) -> float:
    """Distance from the centre of a box at which all its corners just fit the picture, metres.

    Args:
        half: (3,) metres, half the size of the box along each axis.
        direction: (3,) unit vector from its centre to the camera.
        slope: of the ray through the picture's upper edge.
        aspect: width by height of the picture.
    """
    signs = np.stack(np.meshgrid(*[[-1.0, 1.0]] * 3), axis=-1).reshape(-1, 3)
    right = np.cross([0.0, 0.0, 1.0], direction)
    # Straight from above, x is to the right.
    right = right / np.linalg.norm(right) if np.any(right) else np.array([1.0, 0.0, 0.0])
    up = np.cross(direction, right)
    corners = signs * half
    aside = np.maximum(np.abs(corners @ right) / aspect, np.abs(corners @ up)) / slope
    return float((aside + corners @ direction).max())


def percentile_corners(points: Vector) -> Vector:
    """5th and 95th percentile (2, 3) of points (N, 3); (0, 3) without points."""
    return np.percentile(points, [5, 95], axis=0) if len(points) else points


def near_corners(points: Vector, sensors: Vector) -> tuple[Vector, Vector]:
    """Lowest and highest corner of the box around the sensors and the points near them.

    Args:
        points: (N, 3) metres.
        sensors: (S, 3) metres.
    """
    near = _near(points, sensors)
    # Outliers among the points are left out; every sensor stays in view.
    seen = np.vstack([sensors, np.percentile(near, [5, 95], axis=0)]) if len(near) else sensors
    if len(seen) == 0:
        seen = np.zeros((1, 3))
    return seen.min(axis=0), seen.max(axis=0)


def _near(points: Vector, sensors: Vector) -> Vector:
    """Points within `_REACH` of the sensors' centre, and a minimum share of them in any case.

    The share is small for several sensors, which see walls all around, and large for a single
    one, which is aimed at its subject.
    """
    if len(points) == 0 or len(sensors) == 0:
        return points
    distance = np.linalg.norm(points - sensors.mean(axis=0), axis=1)
    part = 0.1 if len(sensors) > 1 else 0.9
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
