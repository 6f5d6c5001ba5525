"""Settings of the drawing, independent of the estimate."""

from dataclasses import dataclass

from app.scene.colours import Colour
from app.scene.palettes import PAPER, Palette, palette
from app.scene.theme import background

LAYERS = (
    "Robot",
    "Sensors",
    "Frustums",
    "Source",
    "Target",
    "Flow",
    "Truth",
    "True object",
    "Grid and axes",
)
"""Layers that can be hidden, in the order of the list on the page."""

SHOWN, DIMMED, HIDDEN = "Shown", "Dimmed", "Hidden"
STATIC_SCENE = (SHOWN, DIMMED, HIDDEN)
"""How points of both clouds that do not move are drawn."""

SOFT, WHITE, TRANSPARENT = "Soft", "White", "Transparent"
"""Backgrounds of the drawing: the page's soft tone, white, or none in a picture."""

ONE_COLOUR, BY_SPEED, BY_DIRECTION, BY_CLUSTER = "One colour", "Speed", "Direction", "Cluster"
ARROW_COLOURS = (ONE_COLOUR, BY_SPEED, BY_DIRECTION, BY_CLUSTER)
"""Quantities that an arrow's colour can encode."""


@dataclass(frozen=True)
class ViewSettings:
    """Settings of the drawing.

    Attributes:
        static_scene: how points that do not move are drawn, one of `STATIC_SCENE`.
        arrow_scale: an arrow's length is so many times the displacement over the pair.
        point_size: diameter of a point that moves, at the look-at point, pixels of a picture 720
            pixels high.
        arrow_colours: quantity that an arrow's colour encodes, one of `ARROW_COLOURS`.
        colours: name of the palette.
        dark: whether the page is dark.
        behind: background of the drawing, `SOFT` on the page.
        follows_system: whether it is dark as the system is, until a person chooses.
        legend: whether a legend lies over the scene.
        layers: that are visible.
        strip: quantity that the timeline draws, by its name in a survey.
    """

    static_scene: str = DIMMED
    arrow_scale: float = 1.0
    point_size: float = 7.0
    arrow_colours: str = ONE_COLOUR
    colours: str = PAPER
    dark: bool = False
    behind: str = SOFT
    follows_system: bool = True
    legend: bool = True
    layers: frozenset[str] = frozenset(LAYERS)
    strip: str = "moving"

    @property
    def palette(self) -> Palette:
        """The colours to draw with."""
        return palette(self.colours, self.dark)

    @property
    def background(self) -> Colour:
        """Colour that what stands back is blended with."""
        return (255, 255, 255) if self.behind == WHITE else background(self.dark)
