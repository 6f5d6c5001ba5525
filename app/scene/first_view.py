"""Where the camera stands at first: everything that matters in the picture, at a slant."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]


@dataclass(frozen=True)
class View:
    """A camera: where it stands, what it looks at, and which way is up; (3,) each."""

    position: Vector
    look_at: Vector
    up: Vector


def up_of(fixed_frame: str) -> Vector:
    """Which way is up: z, but minus y in an optical frame, whose y axis points down."""
    optical = fixed_frame.endswith("optical_frame")
    return np.array([0.0, -1.0, 0.0]) if optical else np.array([0.0, 0.0, 1.0])


def first_view(
    points: NDArray[np.float64], sensors: NDArray[np.float64], fixed_frame: str, fov: float
) -> View:
    """A view of the sensors and of what they see near by.

    Args:
        points: (N, 3) metres in the fixed frame.
        sensors: (S, 3) metres, where the sensors are; NaN where not known.
        fixed_frame: its name.
        fov: vertical field of view of the camera, rad.
    """
    up = up_of(fixed_frame)
    sensors = sensors[np.isfinite(sensors).all(axis=1)]
    seen = np.vstack([sensors, _near(points, sensors)])
    if len(seen) == 0:
        seen = np.zeros((1, 3))
    low, high = np.percentile(seen, [2, 98], axis=0)
    centre = (low + high) / 2
    radius = max(float(np.linalg.norm(high - low)) / 2, 0.4)
    direction = _direction(centre, sensors, up)
    return View(centre + direction * 1.05 * radius / np.sin(fov / 2), centre, up)


def _near(points: Vector, sensors: Vector) -> Vector:
    """The nearer half of the points: those far away are walls and floor."""
    if len(points) == 0 or len(sensors) == 0:
        return points
    distance = np.linalg.norm(points - sensors.mean(axis=0), axis=1)
    return points[distance <= np.median(distance)]


def _direction(centre: Vector, sensors: Vector, up: Vector) -> Vector:
    """A unit vector towards the camera: beside the line of sight, a little behind and above."""
    forward = centre - sensors.mean(axis=0) if len(sensors) else np.zeros(3)
    forward = forward - (forward @ up) * up
    if np.linalg.norm(forward) < 0.1:
        # Sensors all around have no direction of their own: look along the fixed frame's diagonal.
        forward = np.array([0.0, 1.0, 0.0]) if up[2] else np.array([0.0, 0.0, 1.0])
    forward = forward / np.linalg.norm(forward)
    side = np.cross(forward, up)
    direction = side - 0.45 * forward + 0.55 * up
    return direction / np.linalg.norm(direction)
