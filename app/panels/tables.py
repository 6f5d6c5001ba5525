"""Tables of numbers, in the panel's small letters."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from app.scene.colours import Colour, css
from estimator import METRIC_INFO

PLOTTED = tuple(name for name, info in METRIC_INFO.items() if info.plotted)
"""Metrics that the page shows for every pair."""


@dataclass(frozen=True)
class Row:
    """A row of a table.

    Attributes:
        cells: HTML.
        mark: colour of a mark before it, None for none.
        attributes: of its element, such as say what a click on it does.
    """

    cells: Sequence[str]
    mark: Colour | None = None
    attributes: str = ""


def metric_label(name: str) -> str:
    """Short title of a metric with its unit, as the page writes it: "Vel. error [m/s]"."""
    unit = page_unit(METRIC_INFO[name].unit)
    return metric_title(name) + (f" [{unit}]" if unit else "")


def metric_title(name: str) -> str:
    """Short title of a metric at the beginning of a line."""
    short = METRIC_INFO[name].short
    return short[:1].upper() + short[1:]


def page_unit(unit: str) -> str:
    """A unit as the page writes it."""
    return "°" if unit == "deg" else unit


def framed(content: str) -> str:
    """HTML in the panel's small letters."""
    return f'<div style="font-size: 0.75rem; padding: 0 1em; line-height: 1.45">{content}</div>'


def table(head: Sequence[str], rows: Iterable[Row]) -> str:
    """A table under a head of HTML cells."""
    cell = 'style="padding: 0.1em 0.3em; text-align: right; white-space: nowrap"'
    first = "".join(f"<th {cell}>{name}</th>" for name in head)
    body = "".join(
        f'<tr style="border-top: 1px solid rgba(128, 128, 128, 0.3){_look(row)}" {row.attributes}>'
        + "".join(f"<td {cell}>{content}</td>" for content in row.cells)
        + "</tr>"
        for row in rows
    )
    return (
        '<table style="width: 100%; border-collapse: collapse; vertical-align: top; '
        f'font-variant-numeric: tabular-nums"><tr>{first}</tr>{body}</table>'
    )


def signed(value: float, form: str) -> str:
    """A number by a format with a sign, whose minus is as wide as its plus."""
    return form.format(value).replace("-", "−")


def _look(row: Row) -> str:
    mark = f"; box-shadow: inset 3px 0 {css(row.mark)}; font-weight: bold" if row.mark else ""
    return f"{mark}; cursor: pointer" if row.attributes else mark
