"""Depth made visible: what is far behind the scene fades into the background."""

from dataclasses import dataclass

import numpy as np
import viser
from numpy.typing import NDArray

from app.analysis.pairs import Pair
from app.scene.camera import Camera
from app.scene.colours import Colour
from app.scene.drawn_flow import moving_ends

_SHARE = 0.75  # of the background's colour at the farthest points
_LEAST = 0.8  # metres from where fading begins to the farthest points
_FARTHEST = 97  # percentile of the points that counts as the farthest
_HALF, _MOST = 50, 95  # percentiles of the points that stay clear
_CHANGED = 0.03  # relative change of a distance that is seen


@dataclass(frozen=True)
class Extent:
    """What is near in a drawing, and how far its surroundings reach.

    Attributes:
        centre: (3,) metres of the sensors and of what moves, in the drawing.
        radius: metres around it that hold both, and half of all points; of a single sensor's, which
            is aimed at its subject, most.
        reach: metres around it that hold nearly all points.
    """

    centre: NDArray[np.float64]
    radius: float
    reach: float


def extent_of(pair: Pair, R_drawing_fixed: NDArray[np.float64]) -> Extent | None:
    """Extent of a pair's drawing, None where nothing is known."""
    sensors = pair.target.T_fixed_sensor[:, :3, 3]
    near = np.vstack([sensors[np.isfinite(sensors).all(axis=1)], *moving_ends(pair)])
    if len(near) == 0 or len(pair.target.points) == 0:
        return None
    near, points = near @ R_drawing_fixed.T, pair.target.points @ R_drawing_fixed.T
    centre = (near.min(axis=0) + near.max(axis=0)) / 2
    radius = float(np.linalg.norm(near - centre, axis=1).max())
    near_part = _HALF if len(sensors) > 1 else _MOST
    distances = np.linalg.norm(points - centre, axis=1)
    held, reach = np.percentile(distances, [near_part, _FARTHEST]).tolist()
    return Extent(centre, max(radius, held), reach)


def fading(extent: Extent, camera: Camera) -> tuple[float, float]:
    """Distances in metres at which a camera's picture begins to fade, and is all background."""
    # However the camera turns around what it looks at.
    centre = camera.distance + float(np.linalg.norm(extent.centre - camera.look_at))
    begin = centre + extent.radius
    farthest = max(centre + extent.reach, begin + _LEAST)
    return begin, begin + (farthest - begin) / _SHARE


class Depth:
    """Fades what is farther than everything near, for any camera at the same distance."""

    def __init__(self, scene: viser.SceneApi) -> None:
        self._scene = scene
        self._background: Colour = (255, 255, 255)
        self._extent: Extent | None = None
        self._wanted = True
        self._sent: tuple[float, float, Colour, bool] | None = None

    def paint(self, background: Colour, wanted: bool) -> None:
        """Fade into another background, or not at all."""
        self._background, self._wanted = background, wanted

    def show(self, extent: Extent | None) -> None:
        """Suit it to the extent of another pair."""
        self._extent = extent

    def fit(self, camera: Camera) -> None:
        """Suit it to a camera."""
        extent = self._extent
        if extent is None:
            self._send(1.0, 2.0, False)
            return
        self._send(*fading(extent, camera), self._wanted)

    def _send(self, near: float, far: float, enabled: bool) -> None:
        wanted = (near, far, self._background, enabled)
        if self._sent is not None and self._sent[2:] == wanted[2:]:
            same = np.isclose(self._sent[:2], wanted[:2], rtol=_CHANGED).all()
            if not enabled or same:
                return
        self._sent = wanted
        self._scene.configure_fog(near, far, color=self._background, enabled=enabled)
