"""Floor: a grid, and where a robot stands on it, a plane with the robot's soft shadow."""

from dataclasses import dataclass

import numpy as np
import viser
from numpy.typing import NDArray

from app.scene.palettes import Palette

GRID = "/grid"
_SHADOW = f"{GRID}/shadow"

_FINE, _COARSE = (0.25, 1.0), (1.0, 5.0)  # metres between thin and between thick lines
_COARSE_FROM = 8.0  # metres from the camera to the point that it looks at
_FADED, _FADED_PART = 9.0, 2.5  # where lines end: metres, and a multiple of that distance
_LIFTED = 0.003  # metres of the shadow above the plane, which is drawn before it
_PIXELS = 96
_OPACITY = 0.55  # of the plane, through which points below are seen
_DARKEST = 0.45  # opacity of the shadow's middle
_LOW, _BELOW = 2, 0.05  # percentile of moving points that counts as the lowest; metres
_LEVEL = 0.99  # cosine of the angle between a base's axis and the vertical
_FOOT = 0.1  # metres above a base's lowest vertex that its foot reaches


SHADOW_SIZE = 2.4
"""Size of the shadow, of what the robot stands on."""


@dataclass(frozen=True)
class Lines:
    """The grid's lines as a camera sees them.

    Attributes:
        thin: metres from one thin line to the next.
        thick: metres from one thick line to the next.
        fade: metres from the camera at which lines have faded.
    """

    thin: float
    thick: float
    fade: float


def lines_at(distance: float) -> Lines:
    """The lines for a camera at this distance in metres from the point that it looks at."""
    thin, thick = _FINE if distance < _COARSE_FROM else _COARSE
    return Lines(thin, thick, max(_FADED, _FADED_PART * distance))


def shadow_opacity(part: NDArray[np.float64]) -> NDArray[np.float64]:
    """Opacity of the shadow, part of the way from its edge, 0, to its middle, 1."""
    return _DARKEST * part**2 * (3 - 2 * part)  # smooth at both ends


@dataclass(frozen=True)
class Foot:
    """What a robot stands on.

    Attributes:
        centre: (3,) metres in the drawing, at the height of its base.
        size: (2,) metres along x and y.
    """

    centre: NDArray[np.float64]
    size: NDArray[np.float64]


def foot_of(vertices: NDArray[np.float64], T_drawing_base: NDArray[np.float64]) -> Foot | None:
    """The foot of a robot, None where its base is tilted or unknown.

    Args:
        vertices: (V, 3) metres of the base's meshes, in the base.
        T_drawing_base: (4, 4), NaN where unknown.
    """
    if len(vertices) == 0 or not T_drawing_base[2, 2] > _LEVEL:
        return None
    placed = vertices @ T_drawing_base[:3, :3].T + T_drawing_base[:3, 3]
    low = placed[placed[:, 2] < placed[:, 2].min() + _FOOT]
    ends = low.min(axis=0), low.max(axis=0)
    centre = np.array([*(ends[0] + ends[1])[:2] / 2, T_drawing_base[2, 3]])
    return Foot(centre, (ends[1] - ends[0])[:2])


class Floor:
    """Grid in a drawing whose z axis points up.

    Where a robot stands upright the grid is at its base, with a plane and a shadow. A recording in
    an optical frame does not say where up is, and gets none.
    """

    def __init__(self, scene: viser.SceneApi, palette: Palette) -> None:
        self._wanted, self._known, self._solid = True, True, True
        self._foot: Foot | None = None
        self._covers = False
        self._grid = scene.add_grid(
            GRID,
            cell_size=_FINE[0],
            section_size=_FINE[1],
            infinite_grid=True,
            shadow_opacity=0.0,
            fade_distance=_FADED,
        )
        self._shadow = scene.add_image(
            _SHADOW,
            _soft_disc(),
            1.0,
            1.0,
            position=(0.0, 0.0, _LIFTED),
            cast_shadow=False,
            receive_shadow=False,
        )
        self.paint(palette)
        self.stand(None)

    def paint(self, palette: Palette) -> None:
        """Apply a palette's colours."""
        self._grid.cell_color, self._grid.section_color = palette.grid
        self._grid.plane_color = palette.floor

    def know_up(self, known: bool) -> None:
        """Say whether the recording says where up is."""
        self._known = known
        self._show()

    def want(self, wanted: bool) -> None:
        """Show or hide it."""
        self._wanted = wanted
        self._show()

    def make_solid(self, solid: bool) -> None:
        """Draw the plane between the lines, or leave it out; the shadow stays."""
        self._solid = solid
        self._show()

    def stand(self, foot: Foot | None) -> None:
        """Put it under a robot, or through the origin."""
        self._foot, self._covers = foot, False
        self._grid.position = (0.0, 0.0, 0.0) if foot is None else foot.centre
        if foot is not None:
            size = SHADOW_SIZE * foot.size
            self._shadow.render_width, self._shadow.render_height = size.tolist()
        self._show()

    def show(self, moving: NDArray[np.float64]) -> None:
        """Leave the plane out from now on if it would cover moving points (M, 3) below it."""
        if self._foot is not None and not self._covers and len(moving):
            lowest = float(np.percentile(moving[:, 2], _LOW))
            self._covers = lowest < self._foot.centre[2] - _BELOW
            self._show()

    def fit(self, distance: float) -> None:
        """Suit the lines to the distance in metres from the camera to the point it looks at."""
        lines = lines_at(distance)
        self._grid.cell_size, self._grid.section_size = lines.thin, lines.thick
        self._grid.fade_distance = lines.fade

    def _show(self) -> None:
        self._grid.visible = self._wanted and self._known
        plane = self._foot is not None and self._solid and not self._covers
        self._grid.plane_opacity = _OPACITY if plane else 0.0
        self._shadow.visible = self._foot is not None


def _soft_disc() -> NDArray[np.uint8]:
    """Black (N, N, 4) whose opacity falls from the middle to nothing at the edge."""
    along = np.linspace(-1.0, 1.0, _PIXELS)
    x, y = np.meshgrid(along, along)
    part = np.clip(1.0 - np.hypot(x, y), 0.0, 1.0)
    image = np.zeros((_PIXELS, _PIXELS, 4), dtype=np.uint8)
    image[..., 3] = np.round(255 * shadow_opacity(part))
    return image
