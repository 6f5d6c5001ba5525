"""Signals and broken outputs end a command quietly, from the first moment."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from recordings import sample_paths
from tests.conftest import REPOSITORY

SAMPLE = str(sample_paths()[0])
NUMBERS = pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])


def started(*arguments: str, folder: Path, stdout: int) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-m", "app", *arguments],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": str(REPOSITORY), "TMPDIR": str(folder)},
        text=True,
        stderr=subprocess.PIPE,
        stdout=stdout,
    )


@NUMBERS
@pytest.mark.parametrize("after", [0.3, 0.8])
def test_while_modules_load_it_ends_at_once(number: int, after: float, tmp_path: Path):
    process = started("view", SAMPLE, "--port", "0", folder=tmp_path, stdout=subprocess.DEVNULL)
    time.sleep(after)
    process.send_signal(number)
    _, said = process.communicate(timeout=10)
    assert said == ""
    assert process.returncode in (130, -number)


@NUMBERS
def test_a_simulation_that_is_stopped_leaves_nothing(number: int, tmp_path: Path):
    command = ("simulate", "towards", "--trial", "1", "--out", "made")
    process = started(*command, folder=tmp_path, stdout=subprocess.DEVNULL)
    end = time.monotonic() + 10
    while not list(tmp_path.glob("made/*.part")) and time.monotonic() < end:
        time.sleep(0.02)
    process.send_signal(number)
    _, said = process.communicate(timeout=10)
    assert process.returncode == 130
    assert said == ""
    assert [path.suffix for path in (tmp_path / "made").iterdir()] in ([], [".mcap"])


def test_a_full_standard_output_is_one_sentence(tmp_path: Path):
    with Path("/dev/full").open("w") as full:
        process = started("info", SAMPLE, folder=tmp_path, stdout=full.fileno())
        _, said = process.communicate(timeout=10)
    assert said == "tofscope: standard output cannot be written: No space left on device.\n"
    assert process.returncode == 1


def test_a_pipe_that_nothing_reads_and_a_closed_output_are_silent(tmp_path: Path):
    read, written = os.pipe()
    os.close(read)
    process = started("info", SAMPLE, folder=tmp_path, stdout=written)
    os.close(written)
    _, said = process.communicate(timeout=10)
    assert (process.returncode, said) == (0, "")
    closed = [sys.executable, "-m", "app", "info", SAMPLE]
    shell = ["sh", "-c", 'exec "$@" >&-', "sh", *closed]
    done = subprocess.run(shell, cwd=REPOSITORY, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
