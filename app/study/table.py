"""Tables as data, independent of file formats."""

from dataclasses import dataclass

from app.study.rows import Value


@dataclass(frozen=True)
class Column:
    """A column of a table.

    Attributes:
        key: name in CSV and JSON.
        title: heading.
        form: format of its numbers, such as ".3f"; "" for text.
        group: heading shared with neighbouring columns, "" for none.
        from_paper: whether its numbers are the paper's.
    """

    key: str
    title: str
    form: str = ""
    group: str = ""
    from_paper: bool = False

    @property
    def full_title(self) -> str:
        """Title with its group, for formats without a line of groups."""
        return f"{self.group}: {self.title}" if self.group else self.title


@dataclass(frozen=True)
class Table:
    """A table with caption and note.

    Attributes:
        name: in file names.
        title: caption.
        note: definitions and conditions for its readers.
        columns: from left to right.
        rows: each {column key: value}, None where undefined.
    """

    name: str
    title: str
    note: str
    columns: tuple[Column, ...]
    rows: tuple[dict[str, Value], ...]

    @property
    def groups(self) -> list[tuple[str, int]]:
        """(title, number of columns) of each group, from left to right; "" for a single column."""
        found: list[tuple[str, int]] = []
        for column in self.columns:
            if found and column.group and found[-1][0] == column.group:
                found[-1] = (column.group, found[-1][1] + 1)
            else:
                found.append((column.group, 1))
        return found


UNDEFINED = "–"
"""Text of an undefined value."""


def shown(column: Column, value: Value) -> str:
    """Text of a cell."""
    if value is None:
        return UNDEFINED
    return format(value, column.form) if column.form else str(value)
