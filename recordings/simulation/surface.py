"""Optical properties of surfaces for a time-of-flight sensor."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Surface:
    """Optical properties of a surface.

    Attributes:
        reflectance: at 940 nm; the datasheet's white is 0.88 and its grey 0.17.
        drops_out: whether readings of it drop out often, as measured on wooden panels.
    """

    reflectance: float
    drops_out: bool = False


PLASTIC = Surface(0.6)
CLOTH = Surface(0.4)
PAINT = Surface(0.8)
CARDBOARD = Surface(0.5)
STEEL = Surface(0.4)
WOOD = Surface(0.5, drops_out=True)
SCREEN = Surface(0.1, drops_out=True)
