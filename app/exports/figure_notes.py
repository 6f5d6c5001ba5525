"""Texts and signs of a figure: letters of the views, scale bars, axes, legend, corner line.

They are drawn by matplotlib, onto a picture and into a vector file alike.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from app.exports.figure_layout import DOT, RAMP, Box, FigureLayout, PlacedText, text_width
from app.exports.figure_size import TEXT, FigureSize
from app.exports.pinhole import Pinhole
from app.scene.camera import Camera
from app.scene.colours import Colour, css
from app.scene.legend import Legend, Ramp
from app.scene.palettes import blend
from app.scene.scale_bar import scale_bar

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_INK, _LIGHT_INK = "#26282c", "#e6e7ea"
_CARD, _DARK_CARD = "#ffffffd9", "#1c1d20cd"
_CARD_OPACITY = "d9"
_LETTER = 1.15 * TEXT
_INSET = 0.7 * TEXT  # from a view's edges, points
_THIN, _BOLD = 0.6, 1.2  # lines, points
_AXIS = 2.1 * TEXT  # length of an axis that lies in the picture's plane, points
_HALO = 1.6  # around lines over the scene, points
_PAD = 0.5  # around letters over the scene, points
_RAMP_STEPS = 48
_ROUNDING = 1e-3  # pixels

SCALE_HEIGHT = _INSET + 1.6 * TEXT
"""Height of a view's lower edge in which its scale bar stands, points."""

_Place = Sequence[float] | NDArray[np.float64]


@dataclass(frozen=True)
class FigureNotes:
    """What is written and drawn beside the scene.

    Attributes:
        legend: None for none.
        corner_line: its parts, empty for none.
        scale: whether each view has a scale bar and named axes.
        dark: whether the ground is dark.
        ground: its colour, None for none; texts then lie on cards.
    """

    legend: Legend | None
    corner_line: tuple[str, ...]
    scale: bool
    dark: bool
    ground: Colour | None = (255, 255, 255)

    @property
    def ink(self) -> str:
        """Colour of texts and lines."""
        return _LIGHT_INK if self.dark else _INK

    @property
    def card(self) -> str:
        """Colour behind texts over the scene."""
        if self.ground is not None:
            return css(self.ground) + _CARD_OPACITY
        return _DARK_CARD if self.dark else _CARD


@contextmanager
def figure_sheet(size: FigureSize) -> Iterator[tuple["Figure", "Axes"]]:
    """Context of an empty figure, and its axes, from the upper left corner in points."""
    import matplotlib as mpl
    from matplotlib.figure import Figure

    # Type 42 and "none" keep text as text; the salt makes equal drawings equal files.
    settings: dict[Any, Any] = {
        "pdf.fonttype": 42,
        "svg.fonttype": "none",
        "svg.hashsalt": "tofscope",
        "font.family": "DejaVu Sans",
        "font.size": TEXT,
    }
    width, height = size.points
    with mpl.rc_context(settings):
        # matplotlib cuts off parts of a pixel.
        inches = ((size.width + _ROUNDING) / size.dpi, (size.height + _ROUNDING) / size.dpi)
        figure = Figure(inches, dpi=size.dpi)
        figure.patch.set_visible(False)
        axes = figure.add_axes((0.0, 0.0, 1.0, 1.0), zorder=2)
        axes.set_xlim(0, width)
        axes.set_ylim(height, 0)
        axes.set_axis_off()
        yield figure, axes


def draw_notes(
    axes: "Axes",
    layout: FigureLayout,
    notes: FigureNotes,
    cameras: tuple[Camera, ...],
    R_drawing_fixed: NDArray[np.float64],
) -> None:
    """Draw everything beside the scene.

    Args:
        axes: of a figure's sheet.
        layout: of the figure.
        notes: what to draw.
        cameras: of each view.
        R_drawing_fixed: (3, 3), of the axes.
    """
    ink = notes.ink
    for index, (box, camera) in enumerate(zip(layout.views, cameras, strict=True)):
        if len(cameras) > 1:
            _write(
                axes,
                f"({chr(ord('a') + index)})",
                box.left + _INSET,
                box.top + _INSET,
                notes,
                va="top",
                size=_LETTER,
                weight="bold",
            )
        if notes.scale:
            _draw_scale_bar(axes, box, camera, notes)
            _draw_axes(axes, box, camera, R_drawing_fixed, notes)
    if notes.ground is None and layout.strip.height:
        _rectangle(axes, layout.strip, notes.card)
    for placed in layout.entries:
        _dot(axes, placed.left + DOT / 2, placed.middle, css(placed.entry.colour))
        _plain(axes, PlacedText(placed.entry.text, placed.text_left, placed.middle), ink)
    if layout.ramp is not None and notes.legend is not None and notes.legend.ramp is not None:
        _draw_ramp(axes, layout.ramp, notes.legend.ramp, ink)
    for line in layout.lines:
        _plain(axes, line, ink)


def _draw_scale_bar(axes: "Axes", box: Box, camera: Camera, notes: FigureNotes) -> None:
    """Draw a bar in the lower right corner of a view, its length above it."""
    bar = scale_bar(camera, box.width, box.height)
    if bar is None:
        return
    right, bottom = box.left + box.width - _INSET, box.top + box.height - _INSET
    _line(axes, (right - bar.pixels, bottom), (right, bottom), notes, _BOLD)
    _write(axes, bar.text, right, bottom - 0.3 * TEXT, notes, ha="right", va="bottom")


def _draw_axes(
    axes: "Axes",
    box: Box,
    camera: Camera,
    R_drawing_fixed: NDArray[np.float64],
    notes: FigureNotes,
) -> None:
    """Draw the fixed frame's axes, named, in the lower left corner of a view."""
    # As seen: to the right and down.
    seen = (R_drawing_fixed.T @ Pinhole(camera, 1.0, 1.0).axes)[:, :2] * _AXIS
    names = seen + 0.75 * TEXT * seen / np.maximum(np.linalg.norm(seen, axis=1), 1e-9)[:, None]
    drawn = np.linalg.norm(seen, axis=1) > 0.2 * _AXIS
    spread = np.vstack([np.zeros(2), names[drawn]])
    low, high = spread.min(axis=0), spread.max(axis=0)
    letter = 0.45 * TEXT
    origin = np.array(
        [
            box.left + _INSET + letter - low[0],
            box.top + box.height - _INSET - letter - high[1],
        ]
    )
    for name, along, end, shown in zip("xyz", seen, names, drawn, strict=True):
        if shown:
            _line(axes, origin, origin + along, notes, _THIN)
            x, y = (origin + end).tolist()
            _write(axes, name, x, y, notes, ha="center", va="center", style="italic")


def _draw_ramp(axes: "Axes", placed: PlacedText, ramp: Ramp, ink: str) -> None:
    _plain(axes, placed, ink)
    left = placed.left + text_width(placed.text) + 0.55 * TEXT
    step = RAMP / _RAMP_STEPS
    colours = blend(ramp.colours, np.linspace(0.0, 1.0, _RAMP_STEPS))
    for index, colour in enumerate(colours):
        red, green, blue = map(int, colour)
        # Each reaches under the next, or seams would show between them.
        width = min(2 * step, RAMP - index * step)
        box = Box(left + index * step, placed.middle - DOT / 2, width, DOT)
        _rectangle(axes, box, css((red, green, blue)))
    end = left + RAMP + 0.55 * TEXT
    _plain(axes, PlacedText(ramp.high, end, placed.middle), ink)


def _plain(axes: "Axes", placed: PlacedText, ink: str) -> None:
    axes.text(
        placed.left,
        placed.middle,
        placed.text,
        color=ink,
        va="center_baseline",
        ha="left",
        parse_math=False,
    )


def _write(
    axes: "Axes", text: str, x: float, y: float, notes: FigureNotes, **style: object
) -> None:
    """Write over the scene, on a card that keeps letters apart from what is behind them."""
    axes.text(
        x,
        y,
        text,
        color=notes.ink,
        bbox={"facecolor": notes.card, "edgecolor": "none", "pad": _PAD},
        parse_math=False,
        **style,  # pyright: ignore[reportArgumentType]
    )


def _line(axes: "Axes", begin: _Place, end: _Place, notes: FigureNotes, width: float) -> None:
    from matplotlib.lines import Line2D

    for colour, thickness in ((notes.card, width + _HALO), (notes.ink, width)):
        line = Line2D([begin[0], end[0]], [begin[1], end[1]], color=colour, linewidth=thickness)
        line.set_solid_capstyle("butt")
        axes.add_line(line)


def _dot(axes: "Axes", x: float, y: float, colour: str) -> None:
    from matplotlib.patches import Circle

    axes.add_patch(Circle((x, y), DOT / 2, facecolor=colour, edgecolor="none"))


def _rectangle(axes: "Axes", box: Box, colour: str) -> None:
    from matplotlib.patches import Rectangle

    axes.add_patch(
        Rectangle((box.left, box.top), box.width, box.height, facecolor=colour, edgecolor="none")
    )
