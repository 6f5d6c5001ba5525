import pytest

from app.terminal.bar import Bar
from app.terminal.output import terminal
from tests.app.terminal.screen import Screen


@pytest.fixture(params=[30, 80])
def bar(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> tuple[Bar, int]:
    monkeypatch.setattr("sys.stdout.isatty", lambda: True)
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.setenv("COLUMNS", str(request.param))
    console = terminal()
    assert console is not None
    return Bar(console, 5), request.param


def test_one_line_is_written_over_and_never_wraps(
    bar: tuple[Bar, int], capsys: pytest.CaptureFixture[str]
):
    shown, width = bar
    shown.show(2, "first " * 30, "3 left")
    shown.show(3, "x\x1b[2J", "2 left")
    screen = Screen(capsys.readouterr().out, width)
    (line,) = screen.lines
    assert line.startswith("3/5 ")
    assert r"x\x1b" in line
    assert line.endswith(" 2 left")
    assert len(line) <= width


def test_a_hidden_bar_leaves_nothing_and_comes_back_below_what_was_printed(
    bar: tuple[Bar, int], capsys: pytest.CaptureFixture[str]
):
    shown, width = bar
    written = ""
    for number in range(3):
        shown.show(number, "name")
        written += capsys.readouterr().out
        assert Screen(written, width).cursor_visible
        assert Screen(written, width).lines[-1].startswith(f"{number}/5")
        shown.hide()
        print(f"row {number}")
        written += capsys.readouterr().out
        assert Screen(written, width).lines == [f"row {i}" for i in range(number + 1)]
    shown.hide()
    written += capsys.readouterr().out
    assert Screen(written, width).lines == ["row 0", "row 1", "row 2"]
