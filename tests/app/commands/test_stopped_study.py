"""Studies that are stopped, and the same command given again."""

import os
import re
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from app.output.scratch import scratch_folder
from tests.app.waiting import until
from tests.conftest import REPOSITORY
from tests.recordings.room import write_room


class Study:
    """A study by two processes, and by one when it is run again.

    Args:
        given: folder of the recordings.
        folder: for its results and temporary files.
    """

    def __init__(self, given: Path, folder: Path) -> None:
        self.results, self.scratch = folder / "results", folder / "scratch"
        self.scratch.mkdir()
        asked = ["--recordings", str(given), "--sweep", "--method", "baseline"]
        self._command = [sys.executable, "-m", "app", "study", "--out", str(folder), *asked]
        self._options: dict[str, Any] = {
            "cwd": folder,
            "env": os.environ | {"PYTHONPATH": str(REPOSITORY), "TMPDIR": str(self.scratch)},
            "text": True,
        }

    def start(self) -> subprocess.Popen[str]:
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
        # A session of its own: its process group has all of its processes and no other.
        return subprocess.Popen(
            [*self._command, "--jobs", "2"], start_new_session=True, **pipes, **self._options
        )

    def run(self) -> str:
        """Run to the end, and return what is printed."""
        ended = subprocess.run(
            [*self._command, "--jobs", "1"], capture_output=True, check=True, **self._options
        )
        return ended.stdout

    def kept(self) -> dict[Path, int]:
        """{result file: time of its last change in nanoseconds}."""
        return {path: path.stat().st_mtime_ns for path in self.results.glob("*.json")}


@pytest.fixture(scope="module")
def given(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of three recordings, the first of which is finished soon."""
    folder = tmp_path_factory.mktemp("given")
    for name, frames in (("a", 9), ("b", 18), ("c", 18)):
        write_room(folder / f"{name}.mcap", frames, seed=ord(name))
    return folder


@pytest.fixture
def study(given: Path, tmp_path: Path) -> Study:
    return Study(given, tmp_path)


def stop_after_the_first(
    study: Study, stop: Callable[[subprocess.Popen[str]], None]
) -> dict[Path, int]:
    """Start a study, stop it once a result is kept, and return what is kept in the end."""
    process = study.start()
    until(lambda: list(study.scratch.glob("tofscope-scratch-*")), 30)
    until(study.kept, 30)
    stop(process)
    _, said = process.communicate(timeout=10)
    assert process.returncode == 130
    assert not list(study.scratch.glob("tofscope-scratch-*"))
    # Workers end with the recordings that they are at.
    until(lambda: not _running(process.pid))
    kept = study.kept()
    assert 1 <= len(kept) < 3
    assert said.count("\n") == 1
    assert re.match(rf"Stopped: {len(kept)} of 3 recordings are finished and kept", said)
    return kept


def _running(group: int) -> bool:
    """Whether a process of a group is alive: with the first one gone, a worker."""
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True


def test_a_study_that_is_terminated_keeps_what_is_finished(study: Study):
    stop_after_the_first(study, lambda process: process.terminate())


def test_after_ctrl_c_the_same_command_goes_on(study: Study):
    # Ctrl+C in a terminal signals the whole process group; `kill` ends one process.
    kept = stop_after_the_first(study, lambda process: os.killpg(process.pid, signal.SIGINT))
    said = study.run()
    assert f"{len(kept)} of 3 recordings are known from before." in said
    assert f"{len(kept) + 1}/3" in said
    after = study.kept()
    assert {path: after[path] for path in kept} == kept
    assert len(after) == 3


def test_a_study_that_is_killed_leaves_no_process_and_the_next_one_no_scratch(study: Study):
    process = study.start()
    until(study.kept, 30)
    process.kill()
    _, said = process.communicate(timeout=10)
    assert said == ""
    # Workers end within a second, and with them the process that tracks their resources.
    until(lambda: not _running(process.pid), 5)
    with scratch_folder(study.scratch) as next_one:
        assert list(study.scratch.iterdir()) == [next_one]
