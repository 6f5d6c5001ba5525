"""How things are drawn, whatever was estimated."""

from dataclasses import dataclass

from app.scene.palettes import PAPER, Palette, palette

STATIONARY, UNASSIGNED = "Stationary points", "Unassigned points"

LAYERS = (
    "Robot",
    "Sensors",
    "Frustums",
    "Source",
    STATIONARY,
    UNASSIGNED,
    "Target",
    "Flow",
    "Truth",
    "Truth ghost",
    "Grid and axes",
)
"""What can be shown and hidden, in the order in which it is listed."""

ONE_COLOUR, BY_SPEED, BY_DIRECTION, BY_CLUSTER = "One colour", "Speed", "Direction", "Cluster"
ARROW_COLOURS = (ONE_COLOUR, BY_SPEED, BY_DIRECTION, BY_CLUSTER)
"""What the colour of an arrow can say."""


@dataclass(frozen=True)
class ViewSettings:
    """How things are drawn.

    Attributes:
        arrow_scale: seconds; an arrow is as long as the way that is gone in them.
        point_size: diameter of a point at what the camera looks at, in pixels of a picture that
            is 720 pixels high.
        arrow_colours: what the colour of an arrow says, one of `ARROW_COLOURS`.
        colours: name of the palette.
        dark: whether the page is dark.
        legend: whether a legend lies over the scene.
        layers: those that are shown.
    """

    arrow_scale: float = 0.5
    point_size: float = 5.0
    arrow_colours: str = ONE_COLOUR
    colours: str = PAPER
    dark: bool = False
    legend: bool = True
    layers: frozenset[str] = frozenset(LAYERS)

    @property
    def palette(self) -> Palette:
        """The colours to draw with."""
        return palette(self.colours, self.dark)
