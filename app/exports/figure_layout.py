"""Places in a figure: its views side by side, and below them the legend and the corner line."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from app.errors import InputError
from app.exports.figure_size import TEXT, FigureSize
from app.scene.corner_line import SEPARATOR
from app.scene.legend import Legend, LegendEntry

if TYPE_CHECKING:
    from matplotlib.font_manager import FontProperties

LINE = 1.3 * TEXT
"""Height of a line of text, points."""

DOT = 0.62 * TEXT
"""Diameter of a legend's dot, points."""

RAMP = 8 * TEXT
"""Length of a legend's ramp, points."""

EDGE = 0.45 * TEXT
"""Free space at the edges of a figure, points."""

_GAP = 6.0  # between views, points
_AFTER_DOT = 0.55 * TEXT
_BETWEEN_ENTRIES = 1.5 * TEXT
_LEAST_VIEWS = 0.35  # height of the views, as a part of the figure's


@dataclass(frozen=True)
class Box:
    """Rectangle from the upper left corner of a figure, points, on whole pixels for a view."""

    left: float
    top: float
    width: float
    height: float


@dataclass(frozen=True)
class PlacedEntry:
    """Entry of a legend, and the left end of its dot and the middle of its line, points."""

    entry: LegendEntry
    left: float
    middle: float

    @property
    def text_left(self) -> float:
        """Left end of its text, points."""
        return self.left + DOT + _AFTER_DOT


@dataclass(frozen=True)
class PlacedText:
    """Text with its left end and the middle of its line, points."""

    text: str
    left: float
    middle: float


@dataclass(frozen=True)
class FigureLayout:
    """Places of everything in a figure.

    Attributes:
        views: of each view.
        strip: of the texts below them; without height where there is none.
        entries: of the legend.
        ramp: text at the low end of the legend's ramp, None without one.
        lines: of the corner line.
    """

    views: tuple[Box, ...]
    strip: Box
    entries: tuple[PlacedEntry, ...]
    ramp: PlacedText | None
    lines: tuple[PlacedText, ...]


def figure_layout(
    size: FigureSize,
    views: int,
    legend: Legend | None,
    corner_line: Sequence[str],
    least_strip: float = 0.0,
) -> FigureLayout:
    """Lay out a figure.

    Args:
        size: of the figure.
        views: how many stand side by side.
        legend: below them, None for none.
        corner_line: its parts, below that; empty for none.
        least_strip: height of the texts below the views at least, points.

    Raises:
        InputError: the figure is too small for its texts.
    """
    width, height = size.points
    rows = _rows(legend, width - 2 * EDGE)
    lines = _wrapped(corner_line, width - 2 * EDGE)
    count = len(rows) + len(lines)
    strip = max(count * LINE + 2 * EDGE if count else 0.0, least_strip)
    if height - strip < _LEAST_VIEWS * height:
        raise InputError(
            f"A figure of {size.text} has no room for its legend and corner line; make it larger, "
            "or leave them out."
        )
    boxes = _view_boxes(size, views, height - strip)
    top = boxes[0].height
    middle = top + EDGE + LINE / 2
    entries: list[PlacedEntry] = []
    ramp: PlacedText | None = None
    for row in rows:
        for left, item in row:
            if isinstance(item, LegendEntry):
                entries.append(PlacedEntry(item, EDGE + left, middle))
            else:
                ramp = PlacedText(item, EDGE + left, middle)
        middle += LINE
    placed: list[PlacedText] = []
    for line in lines:
        placed.append(PlacedText(line, EDGE, middle))
        middle += LINE
    below = Box(0.0, top, width, height - top)
    return FigureLayout(boxes, below, tuple(entries), ramp, tuple(placed))


def text_width(text: str) -> float:
    """Width of a text of the figure, points."""
    from matplotlib.textpath import text_to_path

    width, _, _ = text_to_path.get_text_width_height_descent(text, _font(), ismath=False)
    return float(width)


def _font() -> "FontProperties":
    from matplotlib.font_manager import FontProperties

    return FontProperties(family=["DejaVu Sans"], size=TEXT)


def _view_boxes(size: FigureSize, views: int, height: float) -> tuple[Box, ...]:
    """Equal boxes with a gap between them, on whole pixels."""
    scale = size.pixels_per_point
    gap = round(_GAP * scale) if views > 1 else 0
    width = (size.width - gap * (views - 1)) // views
    tall = int(height * scale)
    return tuple(
        Box(i * (width + gap) / scale, 0.0, width / scale, tall / scale) for i in range(views)
    )


def _rows(legend: Legend | None, width: float) -> list[list[tuple[float, LegendEntry | str]]]:
    """Rows of the legend in equal columns: left end of each entry, or of the ramp's low text."""
    if legend is None:
        return []
    items: list[LegendEntry | str] = [*legend.entries]
    widths = [DOT + _AFTER_DOT + text_width(entry.text) for entry in legend.entries]
    if legend.ramp is not None:
        items.append(legend.ramp.low)
        ends = text_width(legend.ramp.low) + text_width(legend.ramp.high)
        widths.append(ends + RAMP + 2 * _AFTER_DOT)
    if not items:
        return []
    columns = _columns(widths, width)
    rows: list[list[tuple[float, LegendEntry | str]]] = [[] for _ in columns[0]]
    left = 0.0
    for column in columns:
        for row, index in zip(rows, column, strict=False):
            row.append((left, items[index]))
        left += max(widths[index] for index in column) + _BETWEEN_ENTRIES
    return rows


def _columns(widths: Sequence[float], width: float) -> list[range]:
    """Indices of a legend's entries in each of the most columns that fit, at least one."""
    count = len(widths)
    for rows in range(1, count):
        columns = [range(first, min(first + rows, count)) for first in range(0, count, rows)]
        needed = sum(max(widths[index] for index in column) for column in columns)
        if needed + (len(columns) - 1) * _BETWEEN_ENTRIES <= width:
            return columns
    return [range(count)]


def _wrapped(parts: Sequence[str], width: float) -> list[str]:
    """Lines of parts, none wider than a width in points unless a single word is."""
    lines: list[str] = []
    for part in parts:
        # A part is broken only where it is wider than a line.
        between = SEPARATOR
        for piece in [part] if text_width(part) <= width else part.split():
            if lines and text_width(lines[-1] + between + piece) <= width:
                lines[-1] += between + piece
            else:
                lines.append(piece)
            between = " "
    return lines
