"""Settings of the drawing, independent of the estimate."""

from dataclasses import dataclass

from app.scene.palettes import PAPER, Palette, palette

LAYERS = (
    "Robot",
    "Sensors",
    "Frustums",
    "Source",
    "Target",
    "Flow",
    "Truth",
    "Truth ghost",
    "Grid and axes",
)
"""Layers that can be hidden, in the order of the list on the page."""

SHOWN, DIMMED, HIDDEN = "Shown", "Dimmed", "Hidden"
STATIC_SCENE = (SHOWN, DIMMED, HIDDEN)
"""How points of both clouds that do not move are drawn."""

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
        legend: whether a legend lies over the scene.
        layers: that are visible.
    """

    static_scene: str = DIMMED
    arrow_scale: float = 1.0
    point_size: float = 7.0
    arrow_colours: str = ONE_COLOUR
    colours: str = PAPER
    dark: bool = False
    legend: bool = True
    layers: frozenset[str] = frozenset(LAYERS)

    @property
    def palette(self) -> Palette:
        """The colours to draw with."""
        return palette(self.colours, self.dark)
