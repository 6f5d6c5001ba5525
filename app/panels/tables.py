"""HTML tables in the panels' small font."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from app.scene.colours import Colour, css
from estimator import METRIC_INFO

PLOTTED = tuple(name for name, info in METRIC_INFO.items() if info.plotted)
"""Names of the metrics that the page shows."""


@dataclass(frozen=True)
class TableRow:
    """A row of a table.

    Attributes:
        cells: HTML.
        mark: colour of a mark at its left edge, None for none.
        attributes: HTML attributes, such as for clicks.
    """

    cells: Sequence[str]
    mark: Colour | None = None
    attributes: str = ""


def metric_title(name: str) -> str:
    """Title of a metric, capitalised."""
    title = METRIC_INFO[name].title
    return title[:1].upper() + title[1:]


def framed(content: str) -> str:
    """Wrap HTML in the panels' small font."""
    return f'<div style="font-size: 0.75rem; padding: 0 1em; line-height: 1.45">{content}</div>'


def table(
    head: Sequence[str], rows: Iterable[TableRow], groups: Sequence[tuple[str, int]] = ()
) -> str:
    """Table with a head of HTML cells.

    Args:
        head: a cell for each column.
        rows: below it.
        groups: (HTML, number of columns) of a further head above it, none by default.
    """
    cell = 'style="padding: 0.1em 0.3em; text-align: right; white-space: nowrap"'
    first = "".join(f"<th {cell}>{name}</th>" for name in head)
    above = "".join(f'<th {cell} colspan="{width}">{name}</th>' for name, width in groups)
    above = f"<tr>{above}</tr>" if above else ""
    body = "".join(
        f'<tr style="border-top: 1px solid rgba(128, 128, 128, 0.3){_look(row)}" {row.attributes}>'
        + "".join(f"<td {cell}>{content}</td>" for content in row.cells)
        + "</tr>"
        for row in rows
    )
    return (
        '<table style="width: 100%; border-collapse: collapse; vertical-align: top; '
        f'font-variant-numeric: tabular-nums">{above}<tr>{first}</tr>{body}</table>'
    )


def number(value: float | None, form: str, unit: str = "") -> str:
    """Format a number with its unit and a typographic minus, – where it is undefined."""
    if value is None or math.isnan(value):
        return "–"
    return f"{value:{form}}{unit}".replace("-", "−")


def _look(row: TableRow) -> str:
    mark = f"; box-shadow: inset 3px 0 {css(row.mark)}; font-weight: bold" if row.mark else ""
    return f"{mark}; cursor: pointer" if row.attributes else mark
