"""What depends on how far the camera is from what it looks at."""

from dataclasses import dataclass

import numpy as np
import viser
from numpy.typing import NDArray

FOV = np.radians(38.0)
"""Vertical field of view: narrow, so that what is near is not much larger than what is far."""

WIDE_FOV = np.radians(70.0)
"""For a camera that stands in the middle of things."""

_KEPT = 1.5  # metres around what the camera looks at, within which everything is drawn
_CLEARED = 0.45  # of the way to what the camera looks at, at most


def aspect_of(camera: viser.CameraHandle) -> float:
    """Width by height of the scene in the browser whose camera it is."""
    return camera.image_width / max(camera.image_height, 1)


@dataclass(frozen=True)
class Lens:
    """How a camera sees.

    Attributes:
        distance: metres from the camera to what it looks at.
        fov: vertical field of view, rad.
    """

    distance: float
    fov: float

    @classmethod
    def of(cls, camera: viser.CameraHandle | viser.InitialCameraConfig) -> "Lens":
        """The lens of a camera."""
        return cls.between(np.asarray(camera.position), np.asarray(camera.look_at), camera.fov)

    @classmethod
    def between(
        cls, position: NDArray[np.float64], look_at: NDArray[np.float64], fov: float
    ) -> "Lens":
        """The lens of a camera at one point (3,) that looks at another one (3,)."""
        return cls(float(np.linalg.norm(look_at - position)), float(fov))

    @property
    def height(self) -> float:
        """Metres from the bottom of the picture to its top, at what the camera looks at."""
        return 2 * self.distance * float(np.tan(self.fov / 2))

    @property
    def near(self) -> float:
        """Metres from the camera within which nothing is drawn.

        A wall's points just before the camera would be as large as a hand, and hide what matters.
        """
        return max(0.01, min(_CLEARED * self.distance, self.distance - _KEPT))

    def similar(self, other: "Lens") -> bool:
        """Whether nobody could tell the two apart."""
        return bool(np.isclose(self.height, other.height, rtol=0.04))
