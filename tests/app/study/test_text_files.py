import csv
import io

from app.study.table import Column, Table
from app.study.text_files import as_csv, as_markdown, for_terminal
from app.terminal.tables import plain

TABLE = Table(
    "t",
    "A title",
    "A note.",
    (Column("name", "Name"), Column("a", "mean", ".2f", "Angle (deg)"), Column("k", "k", "d")),
    ({"name": "a|b, c", "a": 1 / 3, "k": 7}, {"name": "x_y", "a": None, "k": None}),
)


def test_csv_keeps_numbers_in_full_and_leaves_the_undefined_empty():
    rows = list(csv.DictReader(io.StringIO(as_csv(TABLE))))
    assert rows[0]["name"] == "a|b, c"
    assert float(rows[0]["a"]) == 1 / 3
    assert rows[1] == {"name": "x_y", "a": "", "k": ""}


def test_markdown_has_a_cell_for_every_column_whatever_names_hold():
    lines = as_markdown(TABLE, "Conditions.").splitlines()
    assert lines[2] == "| Name | Angle (deg): mean | k |"
    assert lines[3] == "| --- | ---: | ---: |"
    assert lines[4] == r"| a\|b, c | 0.33 | 7 |"
    assert lines[5] == r"| x\_y | – | – |"
    assert lines[-1] == "A note. Conditions."


def test_columns_at_a_terminal_stand_below_each_other():
    lines = plain(for_terminal(TABLE)).splitlines()
    assert [line.split() for line in lines[:3]] == [
        ["angle"],
        ["Name", "mean", "k"],
        ["a|b,", "c", "0.33", "7"],
    ]
    ends = [
        line.rindex(cell) + len(cell)
        for line, cell in zip(lines[1:3], ("mean", "0.33"), strict=True)
    ]
    assert ends[0] == ends[1]
