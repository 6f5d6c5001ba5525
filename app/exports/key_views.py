"""Camera that moves smoothly along key views."""

from collections.abc import Sequence

import numpy as np

from app.scene.camera import Camera


def camera_between(keys: Sequence[Camera], part: float) -> Camera:
    """The camera on its way along key views.

    It leaves and reaches each of them slowly, and stays upright.

    Args:
        keys: poses at equal times, at least one.
        part: of the way, 0 to 1.
    """
    if len(keys) == 1:
        return keys[0]
    along = min(max(part, 0.0), 1.0) * (len(keys) - 1)
    index = min(int(along), len(keys) - 2)
    return _between(keys[index], keys[index + 1], _eased(along - index))


def _eased(part: float) -> float:
    return part * part * (3 - 2 * part)


def _between(one: Camera, other: Camera, part: float) -> Camera:
    """Camera whose heading, height, distance, look-at point and field of view lie between two."""
    (azimuth, elevation, distance), (its_azimuth, its_elevation, its_distance) = map(
        _seen_from, (one, other)
    )
    turn = (its_azimuth - azimuth + np.pi) % (2 * np.pi) - np.pi  # the shorter way around
    azimuth += part * turn
    elevation += part * (its_elevation - elevation)
    distance *= (its_distance / distance) ** part
    look_at = (1 - part) * np.array(one.look_at) + part * np.array(other.look_at)
    level = np.cos(elevation)
    direction = np.array([level * np.cos(azimuth), level * np.sin(azimuth), np.sin(elevation)])
    fov = (1 - part) * one.fov + part * other.fov
    return Camera.of(look_at + distance * direction, look_at, fov)


def _seen_from(camera: Camera) -> tuple[float, float, float]:
    """Azimuth and elevation of a camera as seen from its look-at point, rad, and distance."""
    away = np.subtract(camera.position, camera.look_at)
    distance = float(np.linalg.norm(away))
    azimuth = float(np.arctan2(away[1], away[0]))
    return azimuth, float(np.arcsin(np.clip(away[2] / distance, -1.0, 1.0))), distance


def key_times(count: int) -> list[float]:
    """Part of the way, 0 to 1, at each of this many frames."""
    return [0.0] if count == 1 else [index / (count - 1) for index in range(count)]
