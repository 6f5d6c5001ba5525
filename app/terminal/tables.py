"""Tables of aligned columns: bold titles at a terminal, plain elsewhere."""

import io
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, NamedTuple

from app.terminal.output import terminal
from robot_assets.printable import printable

if TYPE_CHECKING:
    from rich.table import Table

_ANY_WIDTH = 1_000_000
"""Characters; elsewhere than at a terminal no line is broken."""
_GAP = 2
_NARROWEST = 20
"""Characters of a column whose cells have several lines."""


class ColumnStyle(NamedTuple):
    """A column.

    Attributes:
        title: words that stand below each other, so that the column stays narrow.
        right: whether its cells end below each other, as numbers do.
        wraps: whether its cells may have several lines where the terminal is narrow.
    """

    title: Sequence[str]
    right: bool = False
    wraps: bool = False


def table_of(columns: Iterable[ColumnStyle], rows: Iterable[Iterable[str]]) -> "Table":
    """A table for `show`; control characters in its cells become escapes."""
    from rich.cells import cell_len
    from rich.table import Table
    from rich.text import Text

    table = Table(box=None, pad_edge=False, padding=(0, _GAP, 0, 0))
    lines = [[printable(cell) for cell in row] for row in rows]
    for i, column in enumerate(columns):
        title = [printable(word) for word in column.title]
        cells = [*title, *(line[i] for line in lines)]
        width = max(map(cell_len, cells))
        table.add_column(
            Text("\n".join(title)),
            justify="right" if column.right else "left",
            min_width=min(width, _NARROWEST) if column.wraps else width,
            no_wrap=not column.wraps,
            overflow="fold",
        )
    for line in lines:
        table.add_row(*map(Text, line))
    return table


def show(table: "Table") -> None:
    """Print a table; plainly where there is no terminal, or one too narrow for it."""
    console = terminal()
    needed = sum(column.min_width or 0 for column in table.columns)
    if console and needed + _GAP * (len(table.columns) - 1) <= console.width:
        console.print(table)
    else:
        print(plain(table))


def plain(table: "Table") -> str:
    """A table as lines without colour; none is broken or cut, however wide."""
    from rich.console import Console

    text = io.StringIO()
    console = Console(file=text, width=_ANY_WIDTH, color_system=None, force_jupyter=False)
    console.print(table)
    return "\n".join(line.rstrip() for line in text.getvalue().rstrip("\n").split("\n"))
