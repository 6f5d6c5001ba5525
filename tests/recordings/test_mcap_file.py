import io
import json
from pathlib import Path

import numpy as np
import pytest
from mcap.reader import make_reader
from mcap.writer import CompressionType, Writer

from recordings import RecordingError, open_recording
from recordings.mcap_file import McapFile
from tests.recordings.room import write_room


def conformance_files(shared_data: Path) -> list[Path]:
    return sorted((shared_data / "mcap_conformance").glob("*/*.mcap"))


def in_file_order(file: McapFile) -> list[bytes]:
    """Payloads of all messages."""
    places = [
        (chunk, offset, channel, index)
        for channel in file.channels
        for index, (chunk, offset) in enumerate(
            zip(
                file.table(channel).chunk.tolist(), file.table(channel).offset.tolist(), strict=True
            )
        )
    ]
    ordered = sorted(places, key=lambda place: place[:2])
    return [file.message(channel, index) for _, _, channel, index in ordered]


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
        read = [list(payload) for payload in in_file_order(file)]
        assert read == [[int(byte) for byte in m["data"]] for m in messages], path
        file.close()


@pytest.mark.parametrize("compression", [*CompressionType, None])
def test_the_first_bytes_of_messages_are_those_of_the_messages(
    tmp_path: Path, compression: CompressionType | None
):
    path = tmp_path / "room.mcap"
    made = write_room(tmp_path / "made.mcap", frames=4).path
    path.write_bytes(
        recompressed(made, compression or CompressionType.NONE, compression is not None)
    )
    file = McapFile(path)
    size = 500  # more than some messages have
    for channel, (starts, whole) in zip(
        file.channels, file.starts(file.channels, size), strict=True
    ):
        payloads = [file.message(channel, i) for i in range(len(file.table(channel)))]
        assert whole.tolist() == [len(payload) >= size for payload in payloads]
        expected = [payload[:size] for payload, fits in zip(payloads, whole, strict=True) if fits]
        assert [bytes(row) for row in starts[whole]] == expected
        if compression is not None:
            assert not starts[~whole].any()
    assert file.starts([], size) == []
    file.close()


def test_messages_are_in_the_order_of_their_log_times(tmp_path: Path):
    file = McapFile(write_room(tmp_path / "room.mcap").path)
    for channel in file.channels:
        times = file.table(channel).log_time
        assert (times[1:] >= times[:-1]).all()
    file.close()


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "is empty"),
        (b"root:x:0:0", "is not an MCAP file"),
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
    assert 0.2 < file.message_count / full.message_count < 0.8
    for channel in file.channels:
        same = next(c for c in full.channels if c.topic == channel.topic)
        for index in range(len(file.table(channel))):
            assert file.message(channel, index) == full.message(same, index)
    file.close()
    full.close()


def test_rubbish_in_the_middle_ends_what_can_be_read(tmp_path: Path):
    whole = write_room(tmp_path / "room.mcap").path.read_bytes()
    path = tmp_path / "rubbish.mcap"
    path.write_bytes(whole[: len(whole) // 2] + bytes(300))
    file = McapFile(path)
    assert file.cut_short
    assert file.message_count > 0
    file.close()


def test_a_broken_chunk_is_one_sentence(tmp_path: Path):
    path = write_room(tmp_path / "room.mcap").path
    file = McapFile(path)
    chunk = int(max(table.chunk[len(table) // 2] for table in map(file.table, file.channels)))
    file.close()
    content = bytearray(path.read_bytes())
    content[chunk + 200 : chunk + 300] = bytes(100)
    path.write_bytes(bytes(content))
    with pytest.raises(RecordingError, match="is broken"):
        read_all(path)


def read_all(path: Path) -> None:
    file = McapFile(path)
    try:
        in_file_order(file)
    finally:
        file.close()


def test_what_is_not_broken_is_salvaged(tmp_path: Path):
    path = write_room(tmp_path / "room.mcap").path
    whole = McapFile(path)
    total = whole.message_count
    chunk = int(max(table.chunk[len(table) // 2] for table in map(whole.table, whole.channels)))
    whole.close()
    content = bytearray(path.read_bytes())
    content[chunk + 200 : chunk + 300] = bytes(100)
    path.write_bytes(bytes(content))
    file = McapFile(path, salvage=True)
    assert file.broken_chunks == 1
    held = in_file_order(file)
    assert 0.8 * total < len(held) < total
    file.close()


@pytest.mark.parametrize("compression", list(CompressionType))
def test_flipped_bytes_give_a_recording_or_one_sentence(
    tmp_path: Path, compression: CompressionType
):
    good = recompressed(write_room(tmp_path / "room.mcap", frames=4).path, compression)
    rng = np.random.default_rng(0)
    path = tmp_path / "flipped.mcap"
    refusals: list[str] = []
    for _ in range(40):
        content = bytearray(good)
        for place in rng.integers(8, len(content), 6):
            content[place] ^= int(rng.integers(1, 256))
        path.write_bytes(bytes(content))
        try:
            with open_recording(path) as recording:
                for k in range(len(recording)):
                    recording.cloud(k)
        except RecordingError as error:
            refusals.append(str(error))
    assert len(refusals) < 40
    assert not any("\n" in refusal for refusal in refusals)


def recompressed(path: Path, compression: CompressionType, chunked: bool = True) -> bytes:
    """The same messages in a file with chunks of another kind."""
    buffer = io.BytesIO()
    writer = Writer(buffer, chunk_size=20_000, compression=compression, use_chunking=chunked)
    writer.start(profile="ros2")
    schemas: dict[int, int] = {}
    channels: dict[int, int] = {}
    with path.open("rb") as stream:
        for schema, channel, message in make_reader(stream).iter_messages():
            assert schema is not None
            if schema.id not in schemas:
                schemas[schema.id] = writer.register_schema(
                    schema.name, schema.encoding, schema.data
                )
            if channel.id not in channels:
                channels[channel.id] = writer.register_channel(
                    channel.topic, "cdr", schemas[schema.id]
                )
            writer.add_message(channels[channel.id], message.log_time, message.data, 0)
    writer.finish()
    return buffer.getvalue()
