"""A table as data; how it looks in a file is decided elsewhere."""

from dataclasses import dataclass

from app.study.rows import Value


@dataclass(frozen=True)
class Column:
    """A column.

    Attributes:
        key: in CSV and JSON.
        title: for people.
        form: format of its numbers, such as ".3f"; "" for text.
        group: title that it shares with its neighbours, "" for none.
        from_paper: whether its numbers are the paper's and not ours.
    """

    key: str
    title: str
    form: str = ""
    group: str = ""
    from_paper: bool = False

    @property
    def full_title(self) -> str:
        """With its group, where there is no place for a line of groups."""
        return f"{self.group}: {self.title}" if self.group else self.title


@dataclass(frozen=True)
class Table:
    """A table.

    Attributes:
        name: as in names of files.
        title: its caption.
        note: what to know when reading it.
        columns: in order.
        rows: each {key of a column: value}, None where undefined.
    """

    name: str
    title: str
    note: str
    columns: tuple[Column, ...]
    rows: tuple[dict[str, Value], ...]

    @property
    def groups(self) -> list[tuple[str, int]]:
        """(title, columns) of each group, from left to right; "" for a column without."""
        found: list[tuple[str, int]] = []
        for column in self.columns:
            if found and column.group and found[-1][0] == column.group:
                found[-1] = (column.group, found[-1][1] + 1)
            else:
                found.append((column.group, 1))
        return found


UNDEFINED = "–"
"""How a value that is not defined is shown to people."""


def shown(column: Column, value: Value) -> str:
    """A cell as people read it."""
    if value is None:
        return UNDEFINED
    return format(value, column.form) if column.form else str(value)
