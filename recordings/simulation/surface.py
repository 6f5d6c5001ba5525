"""What a surface is to a time-of-flight sensor."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Surface:
    """How a surface returns the sensor's light.

    Attributes:
        reflectance: share of the light at 940 nm that it returns; the datasheet's white is 0.88
            and its grey 0.17.
        hard: whether readings of it drop out, as those of wooden panels were seen to do.
    """

    reflectance: float
    hard: bool = False


PLASTIC = Surface(0.6)
CLOTH = Surface(0.4)
PAINT = Surface(0.8)
CARDBOARD = Surface(0.5)
STEEL = Surface(0.4)
WOOD = Surface(0.5, hard=True)
SCREEN = Surface(0.1, hard=True)
