"""Folders for temporary files: none stays."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from app.errors import InputError
from app.output.scratch import scratch_folder
from tests.conftest import REPOSITORY

_KILLED = """
import os, sys
from pathlib import Path
from app.output.scratch import scratch_folder
with scratch_folder(Path(sys.argv[1])) as folder:
    (folder / "file").touch()
    os.kill(os.getpid(), 9)
"""


def test_a_folder_is_there_in_its_context_alone(tmp_path: Path):
    with scratch_folder(tmp_path) as folder:
        (folder / "file").touch()
        assert list(tmp_path.iterdir()) == [folder]
    assert not list(tmp_path.iterdir())


def test_a_killed_process_s_folder_is_removed_by_the_next_and_a_used_one_is_not(tmp_path: Path):
    command = [sys.executable, "-c", _KILLED, str(tmp_path)]
    ended = subprocess.run(command, env=os.environ | {"PYTHONPATH": str(REPOSITORY)}, check=False)
    assert ended.returncode == -signal.SIGKILL
    (abandoned,) = tmp_path.iterdir()
    with scratch_folder(tmp_path) as used, scratch_folder(tmp_path) as another:
        assert set(tmp_path.iterdir()) == {used, another}
    assert not abandoned.exists()


def test_what_is_no_folder_of_ours_stays(tmp_path: Path):
    (tmp_path / "kept").mkdir()
    (tmp_path / "place").mkdir()
    (tmp_path / "place" / "file").touch()
    (tmp_path / "tofscope-scratch-link").symlink_to(tmp_path / "place")
    (tmp_path / "tofscope-scratch-file").touch()
    before = sorted(tmp_path.rglob("*"))
    with scratch_folder(tmp_path):
        pass
    assert sorted(tmp_path.rglob("*")) == before


def test_where_nothing_can_be_written_it_says_so(tmp_path: Path):
    with (
        pytest.raises(InputError, match=r"no place for temporary files .*; set TMPDIR"),
        scratch_folder(tmp_path / "missing"),
    ):
        pass
