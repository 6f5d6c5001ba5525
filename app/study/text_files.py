"""Tables as text: CSV, Markdown, and for a terminal."""

import csv
import io
from typing import TYPE_CHECKING

from app.output.text import csv_cell
from app.study.table import Column, Table, shown
from app.terminal.tables import ColumnStyle, table_of

if TYPE_CHECKING:
    from rich.table import Table as RichTable


def as_csv(table: Table) -> str:
    """Comma-separated, numbers in full, empty where undefined; no text is a formula."""
    text = io.StringIO()
    writer = csv.DictWriter(text, [column.key for column in table.columns], lineterminator="\n")
    writer.writeheader()
    writer.writerows({key: csv_cell(row[key]) for key in row} for row in table.rows)
    return text.getvalue()


def as_markdown(table: Table, conditions: str) -> str:
    """With caption and note; `conditions` is a sentence on what was run."""
    lines = [
        [column.full_title for column in table.columns],
        ["---:" if column.form else "---" for column in table.columns],
        *([shown(c, row[c.key]) for c in table.columns] for row in table.rows),
    ]
    body = "\n".join("| " + " | ".join(_escaped(cell) for cell in line) + " |" for line in lines)
    return (
        f"**{_escaped(table.title)}**\n\n{body}\n\n{_escaped(table.note)} {_escaped(conditions)}\n"
    )


def for_terminal(table: Table) -> "RichTable":
    """For a terminal, without its title."""
    columns = [ColumnStyle(_stacked(column), right=bool(column.form)) for column in table.columns]
    rows = ([shown(c, row[c.key]) for c in table.columns] for row in table.rows)
    return table_of(columns, rows)


def _stacked(column: Column) -> list[str]:
    """A title in words below each other, so that the column stays narrow."""
    short = column.group.partition(" ")[0].lower()
    return [word for word in (short, *column.title.split()) if word]


def _escaped(text: str) -> str:
    for character in "\\|*_`<>":
        text = text.replace(character, "\\" + character)
    return text.replace("\n", " ")
