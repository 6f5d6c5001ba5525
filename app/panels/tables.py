"""Tables of numbers, in the panel's small letters."""

from collections.abc import Iterable, Sequence

from app.colours import PICKED, css


def framed(content: str) -> str:
    """HTML in the panel's small letters."""
    return f'<div style="font-size: 0.75rem; padding: 0 1em; line-height: 1.45">{content}</div>'


def table(head: Sequence[str], rows: Iterable[tuple[bool, Sequence[str]]]) -> str:
    """A table whose cells are HTML; rows that are True are marked."""
    cell = 'style="padding: 0.1em 0.3em; text-align: right; white-space: nowrap"'
    first = "".join(f"<th {cell}>{name}</th>" for name in head)
    body = "".join(
        f'<tr style="border-top: 1px solid rgba(128, 128, 128, 0.3){_mark(marked)}">'
        + "".join(f"<td {cell}>{content}</td>" for content in cells)
        + "</tr>"
        for marked, cells in rows
    )
    return (
        '<table style="width: 100%; border-collapse: collapse; vertical-align: top; '
        f'font-variant-numeric: tabular-nums"><tr>{first}</tr>{body}</table>'
    )


def signed(value: float, form: str) -> str:
    """A number by a format with a sign, whose minus is as wide as its plus."""
    return form.format(value).replace("-", "−")


def _mark(marked: bool) -> str:
    return f"; box-shadow: inset 3px 0 {css(PICKED)}; font-weight: bold" if marked else ""
