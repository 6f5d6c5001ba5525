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
