"""Where the camera stands at first: sensors and what is near them in the picture, at a slant."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]

_SMALLEST = 0.15  # metres, half the size of what fills the picture
_REACH = 0.9  # metres around the sensors, within which things matter most


@dataclass(frozen=True)
class View:
    """A camera: where it stands and what it looks at, (3,) each, in the drawing's frame."""

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
    """A view of the sensors and of what they see near by.

    Args:
        points: (N, 3) metres in the fixed frame.
        poses: (S, 4, 4) T_fixed_sensor, NaN where not known.
        R_drawing_fixed: (3, 3) from the fixed frame into one whose z axis points up.
        fov: vertical field of view of the camera, rad.
        aspect: width by height of the picture.
        important: sets of points (M, 3) in the fixed frame, of each of which most are to be seen,
            wherever they are.
    """
    poses = poses[np.isfinite(poses).all(axis=(1, 2))]
    sensors = poses[:, :3, 3] @ R_drawing_fixed.T
    box = [*corners(points @ R_drawing_fixed.T, sensors)]
    for seen in important:
        box += [*spread(seen @ R_drawing_fixed.T)]
    low, high = np.min(box, axis=0), np.max(box, axis=0)
    centre, half = (low + high) / 2, np.maximum((high - low) / 2, _SMALLEST)
    direction = _towards_camera(poses[:, :3, 2] @ R_drawing_fixed.T)
    distance = _distance(half, direction, np.tan(fov / 2), aspect)
    return View(centre + distance * direction, centre)


def _distance(half: Vector, direction: Vector, slope: float, aspect: float) -> float:
    """Metres from the centre of a box at which all its corners are just in the picture.

    Args:
        half: (3,) metres, half the size of the box.
        direction: (3,) unit vector from its centre to the camera.
        slope: of the picture's upper edge.
        aspect: width by height of the picture.
    """
    signs = np.stack(np.meshgrid(*[[-1.0, 1.0]] * 3), axis=-1).reshape(-1, 3)
    right = np.cross([0.0, 0.0, 1.0], direction)
    right = right / np.linalg.norm(right)
    up = np.cross(direction, right)
    ways = signs * half
    aside = np.maximum(np.abs(ways @ right) / aspect, np.abs(ways @ up)) / slope
    return float((aside + ways @ direction).max())


def spread(points: Vector) -> Vector:
    """Two corners (2, 3) of where most points are, none (0, 3) where there are no points."""
    return np.percentile(points, [5, 95], axis=0) if len(points) else points


def corners(points: Vector, sensors: Vector) -> tuple[Vector, Vector]:
    """The lowest and the highest corner of the box around the sensors and what is near them.

    Args:
        points: (N, 3) metres.
        sensors: (S, 3) metres, where they are.
    """
    near = _near(points, sensors)
    # Of the points a few may be wild; of the sensors every one is to be seen.
    seen = np.vstack([sensors, np.percentile(near, [5, 95], axis=0)]) if len(near) else sensors
    if len(seen) == 0:
        seen = np.zeros((1, 3))
    return seen.min(axis=0), seen.max(axis=0)


def _near(points: Vector, sensors: Vector) -> Vector:
    """The points within reach of the sensors' centre, a part of them at the very least.

    Several sensors see the walls on all sides; a single one looks at something.
    """
    if len(points) == 0 or len(sensors) == 0:
        return points
    distance = np.linalg.norm(points - sensors.mean(axis=0), axis=1)
    part = 0.1 if len(sensors) > 1 else 0.9
    return points[distance <= max(_REACH, float(np.quantile(distance, part)))]


def _towards_camera(looking: Vector) -> Vector:
    """A unit vector towards the camera: beside, a little behind and above where sensors look."""
    forward = looking.mean(axis=0) * [1.0, 1.0, 0.0] if len(looking) else np.zeros(3)
    if np.linalg.norm(forward) < 0.3:
        forward = np.array([0.0, 1.0, 0.0])  # sensors all around look nowhere in particular
    forward = forward / np.linalg.norm(forward)
    up = np.array([0.0, 0.0, 1.0])
    direction = np.cross(forward, up) - 0.5 * forward + 0.45 * up
    return direction / np.linalg.norm(direction)
