"""How things are drawn, whatever was estimated."""

from dataclasses import dataclass

LAYERS = (
    "Robot",
    "Sensors",
    "Fields of view",
    "Source",
    "Target",
    "Flow",
    "Truth",
    "Grid and axes",
)
"""What can be shown and hidden, in the order in which it is listed."""


@dataclass(frozen=True)
class ViewSettings:
    """How things are drawn.

    Attributes:
        arrow_scale: seconds; an arrow is as long as the way that is gone in them.
        point_size: radius of a point, metres.
        layers: those that are shown.
    """

    arrow_scale: float = 0.5
    point_size: float = 0.004
    layers: frozenset[str] = frozenset(LAYERS)
