from pathlib import Path

import numpy as np
import pytest
from mcap.opcode import Opcode
from mcap.reader import make_reader
from mcap.writer import CompressionType

from recordings.chunk_indexes import ChunkedTable, chunk_indexes, summary_records
from recordings.mcap_file import McapFile
from recordings.mcap_records import RecordFile
from tests.recordings.room import write_room
from tests.recordings.test_mcap_file import recompressed


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A room in small chunks."""
    folder = tmp_path_factory.mktemp("chunks")
    room = write_room(folder / "room.mcap", frames=20).path
    path = folder / "small.mcap"
    path.write_bytes(recompressed(room, CompressionType.ZSTD))
    return path


@pytest.fixture
def long(path: Path) -> McapFile:
    """The file, opened as if it were a long one."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("recordings.mcap_index.LONG", 1)
        return McapFile(path)


def test_numbers_of_messages_are_those_of_the_statistics(path: Path):
    file = RecordFile(path)
    indexes = chunk_indexes(summary_records(file)[Opcode.CHUNK_INDEX])
    with path.open("rb") as stream:
        summary = make_reader(stream).get_summary()
    assert summary is not None
    assert summary.statistics is not None
    assert indexes.counts() == dict(summary.statistics.channel_message_counts)
    assert indexes.start.tolist() == [c.chunk_start_offset for c in summary.chunk_indexes]
    assert indexes.uncompressed == sum(c.uncompressed_size for c in summary.chunk_indexes)
    file.close()


def test_messages_of_a_long_file_are_those_of_the_same_read_at_once(path: Path, long: McapFile):
    short = McapFile(path)
    assert long.long
    assert not short.long
    for channel in short.channels:
        table, other = short.table(channel), long.table(channel)
        assert isinstance(other, ChunkedTable)
        assert len(other) == len(table)
        assert other.log_time.tolist() == table.log_time.tolist()
        assert other.chunk.tolist() == table.chunk.tolist()
        assert other.offset.tolist() == table.offset.tolist()
        for index in (0, len(table) // 2, len(table) - 1):
            assert other.place(index) == table.place(index)
            assert long.message(channel, index) == short.message(channel, index)
        payloads = [data for piece in range(other.pieces) for data in long.piece(channel, piece)]
        assert payloads == [short.message(channel, index) for index in range(len(table))]
    short.close()
    long.close()


def test_log_times_of_several_topics_are_read_at_once(long: McapFile):
    channels = list(long.channels)
    for channel, times in zip(channels, long.log_times(channels), strict=True):
        assert times.tolist() == long.table(channel).log_time.tolist()
    long.close()


def test_indexes_with_a_hole_between_are_refused(path: Path):
    file = RecordFile(path)
    records = summary_records(file)[Opcode.CHUNK_INDEX]
    file.close()
    moved = bytearray(records[0])
    place = 36 + 2  # offset of the first message index, after the head and its channel
    moved[place] ^= 1
    with pytest.raises(ValueError, match="do not follow each other"):
        chunk_indexes([bytes(moved)])


def test_a_summary_that_miscounts_is_not_used(
    path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr("recordings.mcap_index.LONG", 1)
    content = bytearray(path.read_bytes())
    file = RecordFile(path)
    statistics = summary_records(file)[Opcode.STATISTICS][0]
    file.close()
    at = content.rfind(statistics)
    content[at : at + 8] = (int.from_bytes(statistics[:8], "little") + 1).to_bytes(8, "little")
    wrong = tmp_path / "wrong.mcap"
    wrong.write_bytes(bytes(content))
    opened, right = McapFile(wrong), McapFile(path)
    assert not opened.long
    assert opened.message_count == right.message_count
    assert np.array_equal(
        opened.table(opened.channels[0]).log_time, right.table(right.channels[0]).log_time
    )
    opened.close()
    right.close()
