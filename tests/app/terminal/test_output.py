import pytest

from app.terminal.output import terminal


def test_a_pipe_is_no_terminal_whatever_the_environment_says(monkeypatch: pytest.MonkeyPatch):
    for name in ("FORCE_COLOR", "TTY_COMPATIBLE", "CLICOLOR_FORCE"):
        monkeypatch.setenv(name, "1")
    assert terminal() is None


def test_a_terminal_that_writes_over_is_one(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("sys.stdout.isatty", lambda: True)
    monkeypatch.setenv("TERM", "dumb")
    assert terminal() is None
    monkeypatch.setenv("TERM", "xterm-256color")
    console = terminal()
    assert console is not None
    assert console.is_terminal
