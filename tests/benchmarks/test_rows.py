"""Rows of the benchmark's table, and two tables side by side."""

import json
from dataclasses import asdict

import pytest

from benchmarks import compare, rows
from benchmarks.compare import LAST, lines, read
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


def test_of_several_times_the_median_counts(monkeypatch):
    times = iter([1.0, 10.0, 9.0, 90.0, 2.0, 20.0])
    monkeypatch.setattr(rows, "milliseconds", lambda _: next(times))
    assert against_naive("x", [lambda: None], [lambda: None]) == Row("x", 2.0, naive=20.0)


@pytest.mark.parametrize("text", ["", "{}", "[]", '{"rows": [{"name": "x"}]}', '{"rows": 3}'])
def test_what_is_no_table_is_told_in_a_sentence(text):
    with pytest.raises(ValueError, match=r"^mine is not a table of make bench\.$"):
        read(text, "mine")


def test_the_table_that_is_kept_can_be_read():
    assert read(LAST.read_text(), "the last")


@pytest.mark.parametrize("count", [1, 3])
def test_two_tables_are_compared_or_none_are_given(monkeypatch, capsys, count):
    monkeypatch.setattr("sys.argv", ["compare", *["a.json"] * count])
    with pytest.raises(SystemExit, match="2"):
        compare.main()
    assert "give two tables, or none" in capsys.readouterr().err


def test_without_tables_the_committed_one_is_compared_with_the_last(monkeypatch, capsys, tmp_path):
    last = tmp_path / "last.json"
    last.write_text(json.dumps({"rows": [asdict(Row("pair", 5.0, naive=40.0))]}))
    before = json.dumps({"rows": [asdict(Row("pair", 10.0, naive=40.0))]})
    monkeypatch.setattr("sys.argv", ["compare"])
    monkeypatch.setattr(compare, "LAST", last)
    monkeypatch.setattr(compare, "kept", lambda: before)
    compare.main()
    assert capsys.readouterr().out.splitlines()[-1].endswith("| 2.00 |")


def test_without_a_commit_the_error_says_what_to_give(monkeypatch, tmp_path):
    monkeypatch.setattr(compare, "REPOSITORY", tmp_path)
    monkeypatch.setattr(compare, "LAST", tmp_path / "last.json")
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(tmp_path.parent))
    with pytest.raises(ValueError, match="give two JSON files"):
        compare.kept()


def test_a_missing_table_is_told_in_a_sentence(monkeypatch):
    monkeypatch.setattr("sys.argv", ["compare", "/no/such.json", "/no/such.json"])
    with pytest.raises(SystemExit, match="No such file"):
        compare.main()


def test_ratios_are_compared_where_there_are_any(tmp_path):
    tables = []
    for name, table in (
        ("a", [Row("pair", 10.0, naive=40.0), Row("opening", 50.0), Row("gone", 1.0)]),
        ("b", [Row("pair", 10.0, naive=80.0), Row("opening", 25.0), Row("new", 1.0)]),
    ):
        path = tmp_path / f"{name}.json"
        path.write_text(json.dumps({"machine": "any", "rows": [asdict(row) for row in table]}))
        tables.append(read(path.read_text(), name))
    _, _, pair, opening, gone, new = lines(*tables)
    assert pair == "| pair | 10.00 ms (4.0x) | 10.00 ms (8.0x) | 2.00 |"
    assert opening.endswith("| 2.00 |")
    assert "not measured" in gone
    assert "not measured" in new
    assert tables[0]["pair"].ratio == pytest.approx(4.0)
