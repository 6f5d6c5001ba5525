"""Outputs of all commands: never in place of another file, whole or as they were before."""

import json
from pathlib import Path

import pytest

from app.command_line import main
from app.output.checks import GENERATOR
from recordings import sample_paths
from tests.recordings.room import write_room


@pytest.fixture
def room(tmp_path: Path) -> Path:
    return write_room(tmp_path / "room.mcap", frames=9).path


def test_evaluate_replaces_no_recording(room: Path, capsys: pytest.CaptureFixture[str]):
    content = room.read_bytes()
    other = write_room(room.with_name("other.mcap"), frames=9).path
    assert main(["evaluate", "--json", str(room), str(other)]) == 1
    assert main(["evaluate", str(room), "--json", str(room)]) == 1
    assert room.read_bytes() == content
    said = capsys.readouterr().err.splitlines()
    assert said == [
        f"tofscope evaluate: {room} must end in .json, so that programs know its format.",
        f"tofscope evaluate: {room} is an input, and would be overwritten; give another name.",
    ]


@pytest.mark.parametrize("flag", ["--screenshot", "--html"])
def test_export_replaces_no_recording_that_a_link_names(
    flag: str, room: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    content = room.read_bytes()
    link = tmp_path / ("a.png" if flag == "--screenshot" else "a.html")
    link.symlink_to(room)
    other = write_room(room.with_name("other.mcap"), frames=9).path
    assert main(["export", str(room), flag, str(link)]) == 1
    assert main(["export", str(other), flag, str(link)]) == 1
    assert room.read_bytes() == content
    said = capsys.readouterr().err
    assert "is an input, and would be overwritten" in said
    assert "exists and was not made by this command" in said


def test_a_parameter_file_is_not_replaced_by_a_table(
    room: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    parameters = tmp_path / "parameters.json"
    parameters.write_text('{"n": 5}')
    given = ["--parameters", str(parameters), "--json", str(parameters)]
    assert main(["evaluate", str(room), *given]) == 1
    assert json.loads(parameters.read_text()) == {"n": 5}
    assert "parameters.json is an input" in capsys.readouterr().err


def test_a_study_replaces_no_other_page(
    room: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    site = tmp_path / "site"
    site.mkdir()
    (site / "index.html").write_text("<html>my page</html>")
    assert main(["study", "--recordings", str(room), "--out", str(site)]) == 1
    assert [p.name for p in site.iterdir()] == ["index.html"]
    assert "index.html exists and is not of a study" in capsys.readouterr().err


def test_an_offline_page_on_a_full_disk_leaves_the_one_before(
    room: Path, tmp_path: Path, full_disk: None, capsys: pytest.CaptureFixture[str]
):
    page = tmp_path / "a.html"
    page.write_text(GENERATOR)
    assert main(["export", str(room), "--html", str(page)]) == 1
    assert page.read_text() == GENERATOR
    assert not list(tmp_path.glob(".*"))
    assert "a.html cannot be written: File too large." in capsys.readouterr().err


def test_a_simulation_on_a_full_disk_leaves_the_recording_before(
    tmp_path: Path, full_disk: None, capsys: pytest.CaptureFixture[str]
):
    path = tmp_path / "x.mcap"
    path.symlink_to(sample_paths()[0])
    before = path.read_bytes()
    quick = ["--speed", "1", "--trial", "1", "--noise", "none"]
    assert main(["simulate", "towards", *quick, "--out", str(path)]) == 1
    assert path.read_bytes() == before
    assert [p.name for p in tmp_path.iterdir()] == ["x.mcap"]
    assert "x.mcap cannot be written: File too large." in capsys.readouterr().err
