"""`tofscope evaluate` of many recordings, by several processes and by a cluster."""

import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from app.command_line import main
from tests.app.waiting import until
from tests.conftest import REPOSITORY
from tests.recordings.room import write_room


@pytest.fixture(scope="module")
def given(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of recordings, the first the longest, the second broken, the third without pairs."""
    folder = tmp_path_factory.mktemp("given")
    write_room(folder / "a.mcap", frames=24, tells_points=True, seed=1)
    (folder / "b.mcap").write_bytes(b"nonsense")
    write_room(folder / "c.mcap", frames=4, seed=2)
    write_room(folder / "d.mcap", frames=10, tells_points=True, seed=3)
    return folder


class Answer:
    """What `tofscope evaluate` said of recordings, and wrote."""

    def __init__(self, capsys: pytest.CaptureFixture[str], file: Path, *arguments: str) -> None:
        assert main(["evaluate", *arguments, "--json", str(file)]) == 0
        self.out, self.err = capsys.readouterr()
        self.json = file.read_bytes()


@pytest.fixture
def alone(given: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Answer:
    answer = Answer(capsys, tmp_path / "alone.json", str(given), "--jobs", "1")
    pairs = [row["pairs"] for row in json.loads(answer.json)["recordings"]]
    assert pairs == [16, None, 0, 2]
    return answer


def test_several_processes_say_and_write_what_one_does(
    alone: Answer, given: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    several = Answer(capsys, tmp_path / "several.json", str(given), "--jobs", "3")
    assert vars(several) == vars(alone)
    assert re.findall(r"^[abcd](?= )", several.out, re.MULTILINE) == ["a", "b", "c", "d"]
    first, second = several.err.splitlines()
    assert "b.mcap is not an MCAP file" in first
    assert "c.mcap has no pair" in second


def test_a_cluster_in_another_folder_writes_what_one_process_does(
    alone: Answer,
    given: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    scheduler: str,
):
    cluster = Answer(capsys, tmp_path / "cluster.json", str(given), "--dask", scheduler)
    assert (cluster.json, cluster.out) == (alone.json, alone.out)


def test_a_relative_path_stays_as_it_was_given_on_a_cluster(
    given: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    scheduler: str,
):
    monkeypatch.chdir(given)
    cluster = Answer(capsys, tmp_path / "table.json", "d.mcap", "--dask", scheduler)
    (row,) = json.loads(cluster.json)["recordings"]
    assert (row["path"], row["pairs"]) == ("d.mcap", 2)


@pytest.mark.usefixtures("methods_of_a_test")
def test_workers_know_a_method_of_ones_own(
    given: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    method = f"{REPOSITORY / 'tests' / 'own_methods.py'}:CENTROID"
    common = [str(given), "--method", method]
    one, two = (
        Answer(capsys, tmp_path / f"{jobs}.json", *common, "--jobs", jobs) for jobs in ("1", "2")
    )
    assert one.json == two.json
    assert json.loads(two.json)["recordings"][0]["pairs"] == 16


def test_what_is_unforeseen_is_one_sentence_and_costs_its_recording_alone(
    given: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
):
    from app.analysis.evaluation import evaluate

    def explode(recording: Any, parameters: Any) -> Any:
        if len(recording) == 24:
            raise ZeroDivisionError("oh")
        return evaluate(recording, parameters)

    monkeypatch.setattr("app.commands.evaluate_row.evaluate", explode)
    paths = [str(given / f"{name}.mcap") for name in "ad"]
    assert main(["evaluate", *paths, "--jobs", "1"]) == 0
    out, err = capsys.readouterr()
    assert re.search(r"^a +- ", out, re.MULTILINE)
    assert re.search(r"^d +2 ", out, re.MULTILINE)
    assert f"{paths[0]}: ZeroDivisionError: oh." in err


def test_no_process_is_too_few(given: Path, capsys: pytest.CaptureFixture[str]):
    assert main(["evaluate", str(given), "--jobs", "0"]) == 1
    assert "--jobs must be 1 or more, got 0." in capsys.readouterr().err


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_all_processes(tmp_path: Path, number: signal.Signals):
    for name, frames in (("a", 9), ("b", 60), ("c", 60)):
        write_room(tmp_path / f"{name}.mcap", frames=frames)
    process = subprocess.Popen(
        [sys.executable, "-m", "app", "evaluate", str(tmp_path), "--jobs", "2"],
        start_new_session=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"PYTHONPATH": str(REPOSITORY)},
    )
    assert process.stdout is not None
    while not process.stdout.readline().startswith("a "):
        assert process.poll() is None
    os.killpg(process.pid, number)
    _, said = process.communicate(timeout=10)
    assert process.returncode == 130
    assert said == ""
    until(lambda: not _running(process.pid))


def _running(group: int) -> bool:
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True
