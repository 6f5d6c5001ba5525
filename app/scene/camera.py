"""Pose and field of view of a camera."""

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray


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

    @classmethod
    def of(cls, position: NDArray[np.float64], look_at: NDArray[np.float64], fov: float) -> Self:
        """The camera at a position (3,) that looks at a point (3,)."""
        (x, y, z), (a, b, c) = position.tolist(), look_at.tolist()
        return cls((x, y, z), (a, b, c), float(fov))

    def turned(self, R: NDArray[np.float64]) -> Self:
        """The camera in a frame that R (3, 3) turns into."""
        return self.of(R @ self.position, R @ self.look_at, self.fov)

    @property
    def distance(self) -> float:
        """Metres from the camera to its look-at point."""
        return float(np.linalg.norm(np.subtract(self.look_at, self.position)))

    @property
    def direction(self) -> NDArray[np.float64]:
        """Unit vector (3,) of its gaze; zero for a camera that looks at its own position."""
        return np.subtract(self.look_at, self.position) / max(self.distance, 1e-12)

    def sees(
        self, points: NDArray[np.float64], up: NDArray[np.float64], aspect: float
    ) -> NDArray[np.bool_]:
        """Mask (N,) of the points (N, 3) that its picture shows, in the frame of its pose.

        Args:
            points: metres.
            up: (3,) what points up in the picture.
            aspect: width by height of the picture.
        """
        rays, gaze = points - self.position, self.direction
        right = np.cross(gaze, up)
        right = right / max(float(np.linalg.norm(right)), 1e-12)
        edge = rays @ gaze * np.tan(self.fov / 2)
        inside = np.abs(rays @ np.cross(right, gaze)) < edge
        return inside & (np.abs(rays @ right) < aspect * edge)
