"""Sizes and near plane that follow from the camera's distance and field of view."""

from dataclasses import dataclass

import numpy as np
import viser

from app.scene.camera import Camera

FOV = np.radians(38.0)
"""Vertical field of view, rad: narrow, for little perspective distortion."""

WIDE_FOV = np.radians(70.0)
"""Vertical field of view of a camera on the robot, amid the points, rad."""

_KEPT = 1.5  # metres in front of the look-at point that the near plane never cuts
_SUITS = 0.04  # relative difference of the heights for which one size is right
_CLEARED = 0.45  # maximum distance of the near plane, as a share of that of the look-at point


def aspect_of(camera: viser.CameraHandle) -> float:
    """Aspect ratio, width by height, of the scene in the camera's browser."""
    return camera.image_width / max(camera.image_height, 1)


@dataclass(frozen=True)
class Lens:
    """Viewing distance and field of view of a camera.

    Attributes:
        distance: metres from the camera to its look-at point.
        fov: vertical field of view, rad.
    """

    distance: float
    fov: float

    @classmethod
    def of(cls, camera: Camera) -> "Lens":
        """The lens of a camera."""
        return cls(camera.distance, camera.fov)

    @property
    def height(self) -> float:
        """Height of the picture at the distance of the look-at point, metres."""
        return 2 * self.distance * float(np.tan(self.fov / 2))

    @property
    def near(self) -> float:
        """Distance of the near plane, metres.

        Points of a wall just in front of the camera would cover most of the picture.
        """
        return max(0.01, min(_CLEARED * self.distance, self.distance - _KEPT))

    def similar(self, other: "Lens", part: float = _SUITS) -> bool:
        """Whether heights differ by this part at most; by default, sizes then suit both."""
        return bool(np.isclose(self.height, other.height, rtol=part))
