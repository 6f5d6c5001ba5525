import json
from pathlib import Path

import pytest

from recordings import RecordingError
from recordings.mcap_file import McapFile
from tests.recordings.room import write_room


def conformance_files(shared_data: Path) -> list[Path]:
    return sorted((shared_data / "mcap_conformance").glob("*/*.mcap"))


def test_every_conformance_file_gives_its_channels_and_messages(shared_data: Path):
    files = conformance_files(shared_data)
    assert len(files) > 100
    for path in files:
        records = json.loads(path.with_suffix(".json").read_text())["records"]
        fields = [(r["type"], dict(r["fields"])) for r in records]
        messages = [f for kind, f in fields if kind == "Message"]
        channels = {f["id"]: f["topic"] for kind, f in fields if kind == "Channel"}
        file = McapFile(path)
        assert {str(c.id): c.topic for c in file.channels} == channels, path
        read = [list(payload) for c in file.channels for payload in file.messages(c)]
        assert read == [[int(byte) for byte in m["data"]] for m in messages], path
        file.close()


def test_messages_are_in_the_order_of_their_log_times(tmp_path: Path):
    file = McapFile(write_room(tmp_path / "room.mcap").path)
    for channel in file.channels:
        times = file.tables[channel.id].log_time
        assert (times[1:] >= times[:-1]).all()
    file.close()


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "empty"),
        (b"root:x:0:0", "beginning with"),
        (b"#ROSBAG V2.0\n", "a ROS 1 bag"),
        (b"SQLite format 3\0", "an SQLite file"),
    ],
)
def test_other_files_are_refused_by_name(tmp_path: Path, content: bytes, said: str):
    path = tmp_path / "other.mcap"
    path.write_bytes(content)
    with pytest.raises(RecordingError, match=said):
        McapFile(path)


def test_a_folder_and_a_missing_file_are_refused(tmp_path: Path):
    with pytest.raises(RecordingError, match="is a folder"):
        McapFile(tmp_path)
    with pytest.raises(RecordingError, match="No such file"):
        McapFile(tmp_path / "nothing.mcap")


def test_a_file_cut_short_gives_what_it_holds(tmp_path: Path):
    whole = write_room(tmp_path / "room.mcap").path
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(whole.read_bytes()[: whole.stat().st_size // 2])
    file, full = McapFile(cut), McapFile(whole)
    assert file.cut_short
    assert not full.cut_short
    held = sum(len(table) for table in file.tables.values())
    assert 0.2 < held / sum(len(table) for table in full.tables.values()) < 0.8
    for channel in file.channels:
        same = next(c for c in full.channels if c.topic == channel.topic)
        kept = list(file.messages(channel))
        assert kept == list(full.messages(same))[: len(kept)]
    file.close()
    full.close()


def test_rubbish_in_the_middle_ends_what_can_be_read(tmp_path: Path):
    whole = write_room(tmp_path / "room.mcap").path.read_bytes()
    path = tmp_path / "rubbish.mcap"
    path.write_bytes(whole[: len(whole) // 2] + bytes(300))
    file = McapFile(path)
    assert file.cut_short
    assert any(len(table) for table in file.tables.values())
    file.close()


def test_a_broken_chunk_is_one_sentence(tmp_path: Path):
    path = write_room(tmp_path / "room.mcap").path
    file = McapFile(path)
    chunk = int(max(table.chunk[len(table) // 2] for table in file.tables.values()))
    file.close()
    content = bytearray(path.read_bytes())
    content[chunk + 200 : chunk + 300] = bytes(100)
    path.write_bytes(bytes(content))
    with pytest.raises(RecordingError, match="is broken"):
        read_all(path)


def read_all(path: Path) -> None:
    file = McapFile(path)
    try:
        for channel in file.channels:
            list(file.messages(channel))
    finally:
        file.close()
