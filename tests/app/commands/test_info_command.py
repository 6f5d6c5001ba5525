import json
from pathlib import Path

import pytest

from app.command_line import main
from tests.recordings.room import write_room


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
