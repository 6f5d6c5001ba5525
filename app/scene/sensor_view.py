"""Views from a sensor, and the sensor whose frustum a ray hits."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from app.scene.camera import Camera
from app.scene.framing import Vector
from app.scene.sensors_view import FRUSTUM_DEPTH, half_extents
from recordings import RecordedSensor

_AHEAD = 0.01  # metres from a sensor to the camera, so that its own drawing is behind
_NEAREST, _FARTHEST = 0.3, 1.4  # metres to the look-at point; near enough that nothing is clipped
_WIDER = 1.25  # the picture's field of view, relative to the sensor's
_WIDEST = 2.4  # rad, the widest field of view of the camera
_BEHIND = 0.012  # metres that the sensor's body reaches back
_MARGIN = 0.008  # metres around a frustum that still hit it


def view_from(
    sensor: RecordedSensor,
    pose: NDArray[np.float64],
    depth: float,
    R_drawing_fixed: NDArray[np.float64],
    aspect: float,
) -> tuple[Camera, Vector]:
    """Camera at a sensor along its optical axis, and what points up as in its image.

    Args:
        sensor: whose field of view fills the picture.
        pose: (4, 4) T_fixed_sensor.
        depth: of what it sees, metres, NaN where unknown.
        R_drawing_fixed: (3, 3) from the fixed frame into the drawing's.
        aspect: width by height of the picture.

    Returns:
        Camera and up (3,) in the drawing's frame.
    """
    axes, centre = R_drawing_fixed @ pose[:3, :3], R_drawing_fixed @ pose[:3, 3]
    far = float(np.clip(depth, _NEAREST, _FARTHEST)) if np.isfinite(depth) else _FARTHEST
    half_width, half_height = half_extents(sensor.directions)
    fov = 2 * float(np.arctan(_WIDER * max(half_height, half_width / aspect)))
    position = centre + _AHEAD * axes[:, 2]
    x, y, z = (-axes[:, 1]).tolist()  # the optical frame's y axis points down
    camera = Camera.of(position, position + far * axes[:, 2], min(fov, _WIDEST))
    return camera, (x, y, z)


def sensor_at(
    sensors: Sequence[RecordedSensor],
    poses: NDArray[np.float64],
    origin: NDArray[np.float64],
    direction: NDArray[np.float64],
) -> int | None:
    """Index of the sensor whose drawn frustum a ray hits first, None if it hits none.

    A ray that starts inside of a frustum does not hit it.

    Args:
        sensors: of the recording.
        poses: (S, 4, 4) T_fixed_sensor, NaN where unknown.
        origin: (3,) metres, in the fixed frame.
        direction: (3,) unit vector.
    """
    extents = np.array([half_extents(sensor.directions) for sensor in sensors])
    R, t = poses[:, :3, :3], poses[:, :3, 3]
    # In a sensor's frame a frustum is where normal @ point <= limit, for each of six planes.
    start = np.einsum("sji,sj->si", R, origin - t)
    along = np.einsum("sji,j->si", R, direction)
    width, height = extents[:, 0], extents[:, 1]
    zero, one = np.zeros(len(sensors)), np.ones(len(sensors))
    normals = np.stack(
        [
            np.stack([one, zero, -width], axis=-1),
            np.stack([-one, zero, -width], axis=-1),
            np.stack([zero, one, -height], axis=-1),
            np.stack([zero, -one, -height], axis=-1),
            np.stack([zero, zero, one], axis=-1),
            np.stack([zero, zero, -one], axis=-1),
        ],
        axis=1,
    )
    # Wide enough at the tip for the sensor's body.
    limits = np.array([_MARGIN, _MARGIN, _MARGIN, _MARGIN, FRUSTUM_DEPTH + _MARGIN, _BEHIND])
    room = limits - np.einsum("spi,si->sp", normals, start)
    speed = np.einsum("spi,si->sp", normals, along)
    with np.errstate(divide="ignore", invalid="ignore"):
        crossing = room / speed
    enter = np.where(speed < 0, crossing, -np.inf).max(axis=1)
    leave = np.where(speed > 0, crossing, np.inf).min(axis=1)
    beside = ((speed == 0) & (room < 0)).any(axis=1)
    hit = ~beside & (enter > 0) & (enter <= leave)  # never where a pose is unknown
    return int(np.where(hit, enter, np.inf).argmin()) if hit.any() else None
