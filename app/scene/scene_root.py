"""Parts common to every scene: lights, fixed frame and its axes."""

import numpy as np
import viser
import viser.transforms as vtf
from numpy.typing import NDArray

from app.scene.palettes import Palette

_Lamp = viser.HemisphereLightHandle | viser.DirectionalLightHandle

FIXED = "/fixed"
"""Node of the fixed frame, the parent of everything drawn from a recording."""

AXES = f"{FIXED}/axes"

AXIS_LENGTH, AXIS_RADIUS = 0.12, 0.004
"""Of the fixed frame's axes, metres."""


class SceneRoot:
    """Lights, and the fixed frame with its axes."""

    def __init__(self, scene: viser.SceneApi, palette: Palette) -> None:
        self._lamps = _light(scene)
        self._fixed = scene.add_frame(FIXED, show_axes=False)
        scene.add_frame(AXES, axes_length=AXIS_LENGTH, axes_radius=AXIS_RADIUS, origin_radius=0.0)
        self.paint(palette)

    def paint(self, palette: Palette) -> None:
        """Apply a palette's brightness."""
        for lamp, intensity in self._lamps:
            lamp.intensity = palette.light * intensity

    def orient(self, R_drawing_fixed: NDArray[np.float64]) -> None:
        """Set the orientation (3, 3) of the fixed frame in the drawing."""
        self._fixed.wxyz = vtf.SO3.from_matrix(R_drawing_fixed).wxyz


def says_up(fixed_frame: str) -> bool:
    """Whether the z axis of a fixed frame points up; an optical frame is tilted as its sensor."""
    return not fixed_frame.endswith("optical_frame")


def upright(fixed_frame: str) -> NDArray[np.float64]:
    """R_drawing_fixed (3, 3), from the fixed frame into a drawing whose z axis points up.

    Optical frames have z forward and y down (REP 103); all others have z up already.
    """
    if not says_up(fixed_frame):
        return np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
    return np.eye(3)


def _light(scene: viser.SceneApi) -> list[tuple[_Lamp, float]]:
    """Add a hemisphere light and two lamps, cheaper than an environment map and its shadows.

    Returns:
        Each lamp and its intensity at full light.
    """
    scene.configure_environment_map(None)
    scene.configure_default_lights(enabled=False)
    sky = scene.add_light_hemisphere(
        "/lights/sky", sky_color=(255, 255, 255), ground_color=(190, 195, 205)
    )
    key = scene.add_light_directional(
        "/lights/key", position=(2.0, -3.0, 4.0), color=(255, 250, 243)
    )
    fill = scene.add_light_directional(
        "/lights/fill", position=(-3.0, 2.0, 2.5), color=(235, 242, 255)
    )
    return [(sky, 1.6), (key, 1.5), (fill, 0.6)]
