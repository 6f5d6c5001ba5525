"""Pose and field of view of a camera."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Camera:
    """Pose and field of view of a camera, as plain numbers for saved files.

    Attributes:
        position: metres, in the drawing's frame.
        look_at: point it looks at, metres, in the drawing's frame.
        fov: vertical field of view, rad.
    """

    position: tuple[float, float, float]
    look_at: tuple[float, float, float]
    fov: float
