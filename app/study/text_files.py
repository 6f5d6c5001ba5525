"""Tables as text: CSV, Markdown, and plain for a terminal."""

import csv
import io

from app.study.table import Column, Table, shown


def as_csv(table: Table) -> str:
    """Comma-separated, numbers in full, empty where undefined."""
    text = io.StringIO()
    writer = csv.DictWriter(text, [column.key for column in table.columns], lineterminator="\n")
    writer.writeheader()
    writer.writerows(table.rows)
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


def as_plain(table: Table) -> str:
    """For a terminal: a title, and columns that stand below each other."""
    titles = [_stacked(column) for column in table.columns]
    depth = max(map(len, titles))
    above = [[""] * (depth - len(words)) + words for words in titles]
    body = [[shown(c, row[c.key]) for c in table.columns] for row in table.rows]
    lines = [*map(list, zip(*above, strict=True)), *body]
    widths = [max(len(line[i]) for line in lines) for i in range(len(titles))]
    aligned = [
        "  ".join(
            cell.rjust(width) if column.form else cell.ljust(width)
            for cell, width, column in zip(line, widths, table.columns, strict=True)
        ).rstrip()
        for line in lines
    ]
    return "\n".join([table.title, *aligned, ""])


def _stacked(column: Column) -> list[str]:
    """A title in words below each other, so that the column stays narrow."""
    short = column.group.partition(" ")[0].lower()
    return [word for word in (short, *column.title.split()) if word]


def _escaped(text: str) -> str:
    for character in "\\|*_`<>":
        text = text.replace(character, "\\" + character)
    return text.replace("\n", " ")
