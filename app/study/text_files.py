"""Tables as CSV and Markdown."""

import csv
import io

from app.study.table import Table, shown


def as_csv(table: Table) -> str:
    """Comma-separated, numbers in full, empty where undefined."""
    text = io.StringIO()
    writer = csv.DictWriter(text, [column.key for column in table.columns], lineterminator="\n")
    writer.writeheader()
    writer.writerows(table.rows)
    return text.getvalue()


def as_markdown(table: Table) -> str:
    """With caption and note, for a page or a pull request."""
    lines = [
        [column.full_title for column in table.columns],
        ["---:" if column.form else "---" for column in table.columns],
        *([shown(c, row[c.key]) for c in table.columns] for row in table.rows),
    ]
    body = "\n".join("| " + " | ".join(_escaped(cell) for cell in line) + " |" for line in lines)
    return f"**{_escaped(table.title)}**\n\n{body}\n\n{_escaped(table.note)}\n"


def _escaped(text: str) -> str:
    for character in "\\|*_`<>":
        text = text.replace(character, "\\" + character)
    return text.replace("\n", " ")
