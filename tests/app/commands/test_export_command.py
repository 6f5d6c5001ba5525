import os

import pytest

from app.command_line import main
from recordings import sample_paths
from tests.recordings.room import write_room


def refusal(capsys, *arguments) -> tuple[int, str]:
    """Run `tofscope export`, which must refuse; its exit code and its one line of complaint."""
    try:
        code = main(["export", *map(str, arguments)])
    except SystemExit as error:
        code = int(error.code or 0)
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.count("\n") == 1
    return code, captured.err


@pytest.fixture
def room(tmp_path):
    return write_room(tmp_path / "room.mcap", frames=3).path


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        ([], 2, "one of the arguments --screenshot --html is required"),
        (["--screenshot", "a.png", "--html", "a.html"], 2, "not allowed with argument"),
        (["--screenshot", "a.png", "--size", "1600"], 2, "a size is written 1600x900"),
        (["--screenshot", "a.png", "--size", "9x900"], 2, "each side from 16 to 4096"),
        (["--html", "a.html", "--frames", "3"], 2, "frames are written FIRST:LAST"),
        (["--screenshot", "a.png", "--view", "side"], 2, "invalid choice: 'side'"),
        (["--screenshot", "a.png", "--frame", "3"], 1, "room has no frame 3: its frames are 0 to"),
        (["--screenshot", "a.png", "--frame", "-1"], 1, "room has no frame -1"),
        (["--html", "a.html", "--frames", ":9"], 1, "room has no frame 9"),
        (["--html", "a.html", "--frames", "2:1"], 1, "must not be before the first; got 2:1"),
        (["--html", "a.html", "--frame", "1"], 1, "--frame applies only to --screenshot"),
        (["--screenshot", "a.png", "--frames", "1:2"], 1, "--frames applies only to --html"),
        (["--html", "a.html", "--view", "3d", "top"], 1, "An offline page has one view, got 2"),
        (["--screenshot", "no/a.png"], 1, "no/a.png cannot be written: there is no folder"),
        (["--screenshot", "a.txt"], 1, "a.txt must end in .png"),
        (["--html", "a.png"], 1, "a.png must end in .html"),
        (["--html", "."], 1, ". cannot be written: it is a folder"),
        (["--html", "a.html", "--gamma", "7"], 1, "gamma must be between 0 and 1, got 7"),
    ],
)
def test_wrong_arguments_are_one_sentence(room, monkeypatch, capsys, arguments, code, said):
    monkeypatch.chdir(room.parent)
    assert refusal(capsys, room, *arguments)[0] == code
    assert said in refusal(capsys, room, *arguments)[1]
    assert not list(room.parent.glob("a.*"))


def test_a_file_that_cannot_be_written_is_said_before_anything_is_computed(
    room, tmp_path, monkeypatch, capsys
):
    monkeypatch.setattr("app.exports.offline_page.offline_page", lambda *_: pytest.fail("computed"))
    place = tmp_path / "locked"
    place.mkdir()
    monkeypatch.setattr("app.output.checks.os.access", lambda path, _: path != place)
    code, said = refusal(capsys, room, "--html", place / "a.html")
    assert code == 1
    assert "cannot be written: permission denied" in said


def test_a_path_that_is_no_recording(tmp_path, capsys):
    assert "is a folder" in refusal(capsys, tmp_path, "--html", tmp_path / "a.html")[1]
    code, said = refusal(capsys, tmp_path / "no.mcap", "--html", tmp_path / "a.html")
    assert code == 1
    assert "There is no file or folder" in said


def test_without_chromium_it_says_how_to_get_one(room, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setenv("PLAYWRIGHT_BROWSERS_PATH", str(tmp_path))
    code, said = refusal(capsys, room, "--screenshot", tmp_path / "a.png")
    assert code == 1
    assert "there is none on the PATH" in said
    assert "apt-get install chromium" in said
    assert not (tmp_path / "a.png").exists()


def test_a_page_of_some_frames(tmp_path, capsys):
    sample = next(path for path in sample_paths() if "sideways" in path.name)
    place = tmp_path / "page.html"
    assert main(["export", str(sample), "--frames", "10:12", "--html", str(place)]) == 0
    page = place.read_text()
    assert f"<title>{sample.stem} (simulated)</title>" in page
    assert "10 to 12 of" in page
    assert "delta: 0.04" in page
    said = capsys.readouterr().out
    assert said.startswith(f"{place}: frames 10 to 12 of {sample.stem}")


def test_a_chromium_that_ends_at_once_is_one_sentence(room, tmp_path, monkeypatch, capsys):
    (tmp_path / "bin").mkdir()
    fake = tmp_path / "bin" / "chromium"
    fake.write_text("#!/bin/sh\nexit 7\n")
    fake.chmod(0o755)
    monkeypatch.setenv("PATH", f"{fake.parent}:{os.environ['PATH']}")
    code, said = refusal(capsys, room, "--screenshot", tmp_path / "a.png")
    assert code == 1
    assert f"Chromium at {fake} does not start (it ended at once, with the exit code 7)." in said
