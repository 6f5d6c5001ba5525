"""The command line as a whole: logging, unexpected errors, and `python -m app`."""

import logging
import subprocess
import sys

import pytest

from app.command_line import main
from app.commands import info
from recordings import sample_paths
from tests.conftest import REPOSITORY

SAMPLE = str(sample_paths()[0])


@pytest.fixture
def broken(monkeypatch: pytest.MonkeyPatch):
    """`tofscope info` fails as only a mistake of ours makes it fail."""

    def fail(*_: object) -> None:
        raise ZeroDivisionError("oh")

    monkeypatch.setattr(info, "file_info", fail)


def test_an_unexpected_error_is_a_sentence_and_logged_with_its_traceback(
    broken, capsys: pytest.CaptureFixture[str], caplog: pytest.LogCaptureFixture
):
    assert main(["info", SAMPLE]) == 1
    said = capsys.readouterr().err
    assert "tofscope info: something unexpected went wrong (ZeroDivisionError: oh)" in said
    [record] = [record for record in caplog.records if record.levelno == logging.ERROR]
    assert record.exc_info is not None
    assert record.exc_info[0] is ZeroDivisionError


@pytest.mark.parametrize(("level", "shown"), [("debug", True), ("info", False), ("ERROR", False)])
def test_the_log_level_is_that_of_our_own_messages(level: str, shown: bool):
    assert main(["info", SAMPLE, "--log-level", level]) == 0
    assert logging.getLogger("app.server.session").isEnabledFor(logging.DEBUG) is shown
    assert not logging.getLogger("websockets").isEnabledFor(logging.DEBUG)


@pytest.mark.parametrize("command", ["view", "info", "simulate", "evaluate", "study", "export"])
def test_every_command_has_a_log_level(command: str, capsys: pytest.CaptureFixture[str]):
    with pytest.raises(SystemExit, match="0"):
        main([command, "--help"])
    assert "--log-level" in capsys.readouterr().out


def test_an_unknown_level_lists_the_known_ones(capsys: pytest.CaptureFixture[str]):
    with pytest.raises(SystemExit, match="2"):
        main(["info", SAMPLE, "--log-level", "loud"])
    assert "'loud' (choose from 'debug', 'info'" in capsys.readouterr().err


def test_python_m_app_is_the_same_command():
    command = [sys.executable, "-m", "app", "info", SAMPLE]
    done = subprocess.run(command, cwd=REPOSITORY, capture_output=True, text=True, check=True)
    assert "24: base/0" in done.stdout
