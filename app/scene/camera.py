"""Pose and field of view of a camera."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Camera:
    """Pose and field of view of a camera, as numbers that can be saved.

    Attributes:
        position: metres, in the drawing's frame.
        look_at: what it looks at, metres, in the drawing's frame.
        fov: vertical field of view, rad.
    """

    position: tuple[float, float, float]
    look_at: tuple[float, float, float]
    fov: float
