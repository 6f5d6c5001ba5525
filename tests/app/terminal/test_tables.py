import pytest

from app.terminal.tables import ColumnStyle, plain, show, table_of
from tests.app.terminal.screen import Screen

COLUMNS = (
    ColumnStyle(["name"]),
    ColumnStyle(["mean", "m/s"], right=True),
    ColumnStyle(["said"], wraps=True),
)
LONG = "word " * 60
ROWS = [["a", "1.25", "short"], ["表 [red]b[/red] :smile:", "10.5", LONG], ["x\x1b[31m\n", "7", ""]]


def at_a_terminal(monkeypatch: pytest.MonkeyPatch, columns: int) -> None:
    monkeypatch.setattr("sys.stdout.isatty", lambda: True)
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.setenv("COLUMNS", str(columns))


def test_where_there_is_no_terminal_lines_are_plain_and_whole(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setenv("COLUMNS", "20")
    monkeypatch.setenv("FORCE_COLOR", "1")
    show(table_of(COLUMNS, ROWS))
    assert capsys.readouterr().out.splitlines() == [
        "                         mean",
        "name                      m/s  said",
        "a                        1.25  short",
        # The first sign is two columns wide.
        f"表 [red]b[/red] :smile:  10.5  {LONG}".rstrip(),
        r"x\x1b[31m\n                 7",
    ]


def test_plain_lines_have_no_blanks_at_their_ends():
    assert plain(table_of((ColumnStyle(["a"]), ColumnStyle(["b"])), [["", ""], ["1", ""]])).split(
        "\n"
    ) == [
        "a  b",
        "",
        "1",
    ]


def test_at_a_terminal_titles_are_bold_and_what_wraps_wraps_in_its_column(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
):
    at_a_terminal(monkeypatch, 60)
    show(table_of(COLUMNS, ROWS))
    screen = Screen(capsys.readouterr().out, 60)
    assert "1" in screen.styles
    assert screen.lines[2] == "a                        1.25  short"
    wrapped = [line for line in screen.lines if "word" in line]
    assert len(wrapped) > 5
    assert {line.index("word") for line in wrapped[1:]} == {31}
    assert max(map(len, screen.lines)) <= 60


def test_numbers_are_never_cut_where_a_terminal_is_too_narrow(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
):
    at_a_terminal(monkeypatch, 40)
    show(table_of(COLUMNS, ROWS))
    shown = capsys.readouterr().out
    assert shown == plain(table_of(COLUMNS, ROWS)) + "\n"
