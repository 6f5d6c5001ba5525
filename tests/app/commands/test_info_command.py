import json
from dataclasses import replace
from itertools import islice
from pathlib import Path

import numpy as np
import pytest

from app.command_line import main
from recordings import Provenance
from recordings.simulation import SCENARIOS
from recordings.writer import RecordingWriter
from tests.app.terminal.screen import Screen
from tests.recordings.foreign import ForeignFile, image, twist
from tests.recordings.room import write_room
from tests.recordings.simulation.made import COARSE, RIG, ROBOT, frames, written


def test_info_says_what_each_topic_is_used_as(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    room = write_room(tmp_path / "room.mcap")
    assert main(["info", str(room.path), "--json"]) == 0
    content = json.loads(capsys.readouterr().out)
    topics = {topic["topic"]: topic for topic in content["topics"]}
    assert len(topics) == 2 * 24 + 2
    assert topics["/skin/s3/depth"]["use"] == "sensor ranges"
    assert topics["/skin/s3/depth"]["messages"] == 14
    assert topics["/skin/s3/depth"]["rate"] == pytest.approx(15, abs=0.5)
    assert topics["/skin/s3/camera_info"]["use"] == "sensor intrinsics"
    assert topics["/tf"]["use"] == "poses"
    assert topics["/target/velocity"]["use"] == "truth: velocity"
    assert content["recording"]["frames"] == 14
    assert len(content["recording"]["sensors"]) == 24


def test_info_is_readable_by_people(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    room = write_room(tmp_path / "room.mcap")
    assert main(["info", str(room.path)]) == 0
    said = capsys.readouterr().out
    assert "/skin/s23/depth" in said
    assert "fixed frame   world" in said


def test_info_names_the_rig_of_a_recording_that_says_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    rig = replace(COARSE, name="eyes")
    path = written(tmp_path / "x.mcap", "fast", 2.0, rig=rig)
    assert main(["info", str(path)]) == 0
    lines = capsys.readouterr().out.splitlines()
    number = next(i for i, line in enumerate(lines) if line.startswith("noise         "))
    assert lines[number + 1] == "rig           eyes"


def test_info_of_an_older_recording_has_no_line_for_the_rig(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    about = Provenance(True, "towards", 0.6, 1, 0, "none", "made for a test")
    with RecordingWriter(tmp_path / "x.mcap", ROBOT, RIG, about) as writer:
        for frame in islice(frames(SCENARIOS["towards"]), 2):
            writer.write(frame)
    assert main(["info", str(tmp_path / "x.mcap")]) == 0
    said = capsys.readouterr().out
    assert "noise         none" in said
    assert "rig  " not in said


@pytest.mark.parametrize(
    "name", ["bags/nav2_turtlebot.mcap", "bags/cdr_types.mcap", "bags/foxglove_json_camera.mcap"]
)
def test_info_of_files_that_are_no_recordings_says_why(
    shared_data: Path, name: str, capsys: pytest.CaptureFixture[str]
):
    assert main(["info", str(shared_data / name)]) == 0
    assert "nothing to estimate from" in capsys.readouterr().out


def test_info_of_a_file_that_is_not_mcap_is_one_sentence(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    path = tmp_path / "x.mcap"
    path.write_bytes(b"")
    assert main(["info", str(path)]) == 1
    assert capsys.readouterr().err == f"tofscope info: {path} is empty.\n"


def test_what_a_file_holds_does_a_terminal_no_harm(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    file = ForeignFile()
    evil = image(0, "eye\x1b[2J", np.full((8, 8), 900, "<u2"), "16UC1")
    file.add("/eye\x1b[31m\nimage", "sensor_msgs/msg/Image", evil, 0)
    path = file.write(tmp_path / "a\x07.mcap")
    assert main(["info", str(path)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert all(line.isprintable() for line in lines)
    assert any(line.startswith(r"/eye\x1b[31m\nimage  sensor_msgs/msg/Image") for line in lines)


def test_lines_are_whole_and_plain_where_there_is_no_terminal(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setenv("COLUMNS", "30")
    monkeypatch.setenv("FORCE_COLOR", "1")
    room = write_room(tmp_path / "room.mcap")
    assert main(["info", str(room.path)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert all(line.isprintable() and line == line.rstrip() for line in lines)
    titles, *topics = lines[2 : 2 + 1 + 2 * 24 + 2]
    assert titles.split() == ["topic", "type", "messages", "rate", "longest", "gap", "used", "as"]
    ends = {line.index(" Hz") for line in topics if " Hz" in line}
    assert len(ends) == 1
    begins = {line.rindex("  ") for line in (titles, *topics)}
    assert begins == {titles.index("used as") - 2}


def test_at_a_terminal_the_uses_wrap_and_titles_are_bold(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
):
    file = ForeignFile()
    file.add("/speed", "geometry_msgs/msg/TwistStamped", twist(0, "map", np.zeros(3)), 0)
    large = image(0, "eye", np.zeros((9, 70), "<u2"), "16UC1")
    file.add("/eye", "sensor_msgs/msg/Image", large, 0)
    path = file.write(tmp_path / "x.mcap")
    monkeypatch.setattr("sys.stdout.isatty", lambda: True)
    monkeypatch.setenv("TERM", "xterm-256color")
    monkeypatch.setenv("COLUMNS", "110")
    assert main(["info", str(path)]) == 0
    screen = Screen(capsys.readouterr().out, 110)
    assert "1" in screen.styles
    assert screen.lines[2].startswith("topic")
    used = screen.lines[2].index("used as")
    assert [line[used:] for line in screen.lines[3:6]] == [
        "not used: it is 70 x 9, and a sensor has",
        "2 x 2 to 64 x 64 zones",
        "truth: velocity",
    ]
