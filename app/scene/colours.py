"""Colours of the app, as in the paper's figures: source red, target blue, flow green."""

Colour = tuple[int, int, int]

SOURCE: Colour = (214, 39, 40)
TARGET: Colour = (31, 99, 200)
FLOW: Colour = (0, 130, 45)
TRUTH: Colour = (235, 125, 0)
SENSOR: Colour = (205, 20, 30)
FRUSTUM: Colour = (190, 110, 110)
PICKED: Colour = (214, 0, 147)
BRAND: Colour = (23, 72, 147)  # of which the page shows a lighter shade, with white text
BRIGHT_BRAND: Colour = (90, 150, 245)
"""`BRAND` on a dark page."""


def css(colour: Colour) -> str:
    """The colour in CSS notation."""
    return "#{:02x}{:02x}{:02x}".format(*colour)
