"""Rows of the benchmark's table, and two tables side by side."""

import json
from dataclasses import asdict

import pytest

from benchmarks.compare import lines, read
from benchmarks.rows import Row, against_naive


def test_a_row_says_how_many_times_as_fast_it_is():
    assert Row("pair", 5.0, naive=30.0).line() == "| pair | 5.00 ms | 30.00 | 6.0 |"
    assert Row("memory", 100.0, "MB").line() == "| memory | 100.00 MB |  |  |"


def test_both_ways_run_with_every_input_as_often_as_said():
    ran: list[str] = []
    ours = [lambda: ran.append("ours")] * 3
    row = against_naive("steps", ours, [lambda: ran.append("naive")] * 3, times=2)
    assert ran == ["ours", "naive"] * 6
    assert row.naive is not None


def test_ratios_are_compared_where_there_are_any(tmp_path):
    tables = []
    for name, rows in (
        ("a", [Row("pair", 10.0, naive=40.0), Row("opening", 50.0), Row("gone", 1.0)]),
        ("b", [Row("pair", 10.0, naive=80.0), Row("opening", 25.0), Row("new", 1.0)]),
    ):
        path = tmp_path / f"{name}.json"
        path.write_text(json.dumps({"machine": "any", "rows": [asdict(row) for row in rows]}))
        tables.append(read(path))
    _, _, pair, opening, gone, new = lines(*tables)
    assert pair == "| pair | 10.00 ms (4.0x) | 10.00 ms (8.0x) | 2.00 |"
    assert opening.endswith("| 2.00 |")
    assert "not measured" in gone
    assert "not measured" in new
    assert tables[0]["pair"].ratio == pytest.approx(4.0)
