"""Scale bar of a drawing: a round length, and how long it is in the picture."""

from dataclasses import dataclass

import numpy as np

from app.scene.camera import Camera

_MOST = 0.25  # of the picture's width
_STEPS = (1.0, 2.0, 5.0)


@dataclass(frozen=True)
class ScaleBar:
    """A length at the distance of the camera's look-at point.

    Attributes:
        metres: 1, 2 or 5 times a power of ten.
        pixels: its length in the picture.
    """

    metres: float
    pixels: float

    @property
    def text(self) -> str:
        """The length with its unit."""
        if self.metres >= 1.0:
            return f"{self.metres:g} m"
        if self.metres >= 0.01:
            return f"{100 * self.metres:g} cm"
        return f"{1000 * self.metres:g} mm"


def scale_bar(camera: Camera, width: float, height: float) -> ScaleBar | None:
    """The longest round scale bar of at most a quarter of a picture's width.

    A perspective picture has no one scale: the bar holds at the distance of the look-at point.

    Args:
        camera: of the picture.
        width: of the picture, pixels.
        height: of the picture, pixels.

    Returns:
        The bar, None for a camera that looks at its own position.
    """
    metres_per_pixel = 2 * camera.distance * float(np.tan(camera.fov / 2)) / height
    # Rounding errors must not make the bar shorter by half.
    longest = _MOST * width * metres_per_pixel * (1 + 1e-9)
    if not (np.isfinite(longest) and longest > 0):
        return None
    power = 10.0 ** np.floor(np.log10(longest))
    metres = float(max(step * power for step in _STEPS if step * power <= longest))
    return ScaleBar(metres, metres / metres_per_pixel)
