"""Files that appear once they are complete."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from recordings.draft import Draft

_WRITING = """
import sys, time
from pathlib import Path
from recordings.draft import Draft
draft = Draft(Path(sys.argv[1]))
draft.stream.write(b"half")
draft.stream.flush()
print("written", flush=True)
time.sleep(60)
"""


@pytest.fixture(params=["without a name", "with one"])
def _named(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    if request.param == "with one":
        monkeypatch.delattr(os, "O_TMPFILE", raising=False)


@pytest.mark.usefixtures("_named")
def test_it_takes_the_place_of_what_was_there_once_it_is_complete(tmp_path: Path):
    path = tmp_path / "a.mcap"
    path.write_bytes(b"before")
    (tmp_path / "a.mcap.part").write_bytes(b"of somebody else")
    draft = Draft(path)
    draft.stream.write(b"after")
    assert path.read_bytes() == b"before"
    draft.complete()
    draft.discard()
    assert path.read_bytes() == b"after"
    assert (tmp_path / "a.mcap.part").read_bytes() == b"of somebody else"
    assert len(list(tmp_path.iterdir())) == 2


@pytest.mark.usefixtures("_named")
def test_of_one_that_is_discarded_nothing_stays(tmp_path: Path):
    path = tmp_path / "a.mcap"
    path.write_bytes(b"before")
    draft = Draft(path)
    draft.stream.write(b"after")
    draft.discard()
    assert path.read_bytes() == b"before"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.skipif(not hasattr(os, "O_TMPFILE"), reason="this system has no files without names")
def test_nothing_stays_of_a_process_that_is_killed(tmp_path: Path):
    process = subprocess.Popen(
        [sys.executable, "-c", _WRITING, str(tmp_path / "a.mcap")], stdout=subprocess.PIPE
    )
    assert process.stdout is not None
    assert process.stdout.readline() == b"written\n"
    process.send_signal(signal.SIGKILL)
    process.wait(timeout=10)
    process.stdout.close()
    time.sleep(0.1)
    assert list(tmp_path.iterdir()) == []
