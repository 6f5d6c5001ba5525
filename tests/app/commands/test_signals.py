"""Signals and broken outputs end a command quietly, from the first moment."""

import logging
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from app.commands.signals import raising_keyboard_interrupt
from recordings import sample_paths
from tests.app.waiting import until
from tests.app.wire_client import WireClient
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
    while not (tmp_path / "made").is_dir() and time.monotonic() < end:
        time.sleep(0.02)
    time.sleep(0.3)
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


@NUMBERS
def test_a_server_that_computes_for_a_client_ends_well(number: int, tmp_path: Path):
    process = started("view", SAMPLE, "--port", "0", folder=tmp_path, stdout=subprocess.PIPE)
    assert process.stdout is not None
    address = process.stdout.readline().split()[-1]
    with WireClient(address, lambda *_: None) as client:
        until(lambda: client.has("γ"), 60)
        process.send_signal(number)
        _, said = process.communicate(timeout=20)
    assert (process.returncode, said) == (0, "")


_LIBRARY = """
import os
def disturbed(number):
    try:
        os.kill(os.getpid(), number)
        for _ in range(10):
            pass
    except BaseException as error:
        {then}
"""
_WORKING = """
def work(number, done):
    try:
        disturbed(number)
        done.append("more work")
    except Exception:
        done.append("an error of another kind")
    finally:
        done.append("cleaned")
        done.append("up")
"""


@pytest.mark.parametrize("then", ["pass", "raise ImportError from error"])
@NUMBERS
def test_a_library_that_catches_everything_does_not_keep_a_command_from_ending(
    number: int, then: str
):
    library: dict[str, Any] = {"__name__": "some_library"}
    exec(_LIBRARY.format(then=then), library)
    ours: dict[str, Any] = {"__name__": "app.working", "disturbed": library["disturbed"]}
    exec(_WORKING, ours)
    done: list[str] = []
    hook = sys.unraisablehook
    try:
        with pytest.raises(KeyboardInterrupt), raising_keyboard_interrupt():
            ours["work"](number, done)
    finally:
        sys.settrace(None)
        sys.unraisablehook = hook
        logging.disable(logging.NOTSET)
    assert done == ["cleaned", "up"]


_FAILING_AT_ITS_END = """
import ctypes, os, sys
libc = ctypes.CDLL(None)
libc.__cxa_atexit(ctypes.cast(libc._exit, ctypes.c_void_p), ctypes.c_void_p(1), None)
from app.commands import running
def run(_):
    os.kill(os.getpid(), 15)
running.run = run
from app.command_line import main
sys.exit(main())
"""


def test_a_c_library_that_fails_at_the_end_does_not_change_the_exit_code():
    command = [sys.executable, "-c", _FAILING_AT_ITS_END]
    ended = subprocess.run(command, cwd=REPOSITORY, capture_output=True, text=True, check=False)
    assert (ended.returncode, ended.stderr) == (130, "")
