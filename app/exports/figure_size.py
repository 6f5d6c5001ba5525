"""Size of a figure, and of what is drawn in it, in pixels, millimetres and points."""

from dataclasses import dataclass

from app.errors import InputError

POINTS_PER_INCH = 72.0
MM_PER_INCH = 25.4

TEXT = 7.0
"""Size of a figure's text, points."""

DPI = 300.0
"""Usual resolution of a figure whose size is in millimetres."""

PIXELS = (16, 4096)
"""Ends of the sides of a view."""

MILLIMETRES = (10.0, 1000.0)
"""Ends of the sides of a figure."""

DPIS = (30.0, 1200.0)
"""Ends of its resolution."""

_THIN = 2 / 7  # points of what is one pixel wide in a picture 720 pixels high
_REFERENCE_HEIGHT = 720  # pixels, the height of the picture that sizes in pixels refer to
_LEAST_TEXT = 9.0  # pixels, below which letters cannot be read
_TEXT_OF_HEIGHT, _TEXT_OF_WIDTH = 1 / 52, 1 / 60


@dataclass(frozen=True)
class FigureSize:
    """Size of a whole figure, with all its views.

    Attributes:
        width: pixels.
        height: pixels.
        dpi: pixels per inch, which makes points of its pixels.
        detail: pixels of what is one pixel wide in a picture 720 pixels high.
        printed: whether its size on paper is known.
    """

    width: int
    height: int
    dpi: float
    detail: float
    printed: bool = False

    @classmethod
    def in_pixels(cls, width: int, height: int, views: int = 1) -> "FigureSize":
        """Size of this many views side by side, each of this width and height in pixels.

        What is drawn grows with the height.
        """
        text = min(_TEXT_OF_HEIGHT * height, _TEXT_OF_WIDTH * width * views)
        dpi = POINTS_PER_INCH * max(_LEAST_TEXT, text) / TEXT
        return cls(width * views, height, dpi, height / _REFERENCE_HEIGHT)

    @classmethod
    def in_millimetres(cls, width: float, height: float, dpi: float = DPI) -> "FigureSize":
        """Size of a printed figure, whose texts, lines and points have the same size at any dpi."""
        across, down = (round(side / MM_PER_INCH * dpi) for side in (width, height))
        return cls(across, down, dpi, _THIN * dpi / POINTS_PER_INCH, printed=True)

    def check(self) -> None:
        """Check that a browser can draw it in reasonable time.

        Raises:
            InputError: it has too few or too many pixels.
        """
        least, most = PIXELS[0], 2 * PIXELS[1]
        if not least <= min(self.width, self.height) <= max(self.width, self.height) <= most:
            raise InputError(
                f"The picture would have {self.width} x {self.height} pixels, and each side may "
                f"have {least} to {most}; choose another size or resolution."
            )

    @property
    def text(self) -> str:
        """Width and height, for a person."""
        pixels = f"{self.width} x {self.height}"
        if not self.printed:
            return pixels
        width, height = (MM_PER_INCH * side / self.dpi for side in (self.width, self.height))
        return f"{width:.0f} mm x {height:.0f} mm, {pixels} pixels"

    @property
    def pixels_per_point(self) -> float:
        """Pixels of a point."""
        return self.dpi / POINTS_PER_INCH

    @property
    def points(self) -> tuple[float, float]:
        """Width and height in points."""
        return self.width / self.pixels_per_point, self.height / self.pixels_per_point
