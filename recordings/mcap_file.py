"""MCAP file: channels, an index of the messages, and random access to messages."""

import struct
import threading
from collections import OrderedDict
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import IO

from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.reader import SeekingReader
from mcap.records import Chunk, MessageIndex
from zstandard import ZstdError

from recordings.errors import BrokenFileError, RecordingError
from recordings.mcap_contents import (
    MESSAGE_HEAD,
    RECORD_HEAD,
    SCANNED,
    UNCHUNKED,
    ChannelInfo,
    Contents,
    add_record,
    chunk_data,
    merged_channels,
    message_table,
)
from robot_assets.input_files import open_file

MAGIC = b"\x89MCAP0\r\n"
_OTHER_MAGIC = {
    b"#ROSBAG V2.0": "a ROS 1 bag",
    b"SQLite format 3\0": "an SQLite file, perhaps a ROS 2 bag in that format",
}
_CACHED_BYTES = 64 * 2**20  # of decompressed chunks
_BROKEN = (
    McapError,
    OSError,
    ValueError,  # also a chunk whose CRC is wrong
    EOFError,
    struct.error,
    KeyError,
    UnicodeDecodeError,
    OverflowError,
    MemoryError,  # a length that is nonsense
    RuntimeError,  # lz4
    ZstdError,
)


class McapFile:
    """MCAP file opened for reading; thread-safe.

    The file's own index is used where it is complete. Otherwise (no summary, no message index, cut
    short while recording) the whole file is scanned once to make one.

    Args:
        path: the file.
        salvage: ignore the file's index, scan it, and leave broken chunks out.

    Raises:
        RecordingError: the file does not exist or is not MCAP.
        BrokenFileError: it is broken.
    """

    def __init__(self, path: Path, salvage: bool = False) -> None:
        self.path = path
        self._lock = threading.Lock()
        self._chunks: OrderedDict[int, bytes] = OrderedDict()
        self._stream = _opened(path)
        try:
            contents = (None if salvage else self._from_index()) or self._scanned()
            self.channels, locations = merged_channels(contents)
            self.tables = {c.id: message_table(locations[c.id]) for c in self.channels}
        except _BROKEN as error:
            self._stream.close()
            raise BrokenFileError(f"{path} is a broken MCAP file: {_text(error)}.") from error
        self.cut_short = contents.cut_short
        self.broken_chunks = contents.broken_chunks
        self.metadata = contents.metadata
        self.attachments = contents.attachments

    def message(self, channel: ChannelInfo, index: int) -> bytes:
        """Payload of a channel's message, by its index in the channel's table."""
        table = self.tables[channel.id]
        chunk, offset = int(table.chunk[index]), int(table.offset[index])
        try:
            with self._lock:
                if chunk == UNCHUNKED:
                    self._stream.seek(offset)
                    _, length = RECORD_HEAD.unpack(self._stream.read(RECORD_HEAD.size))
                    return self._stream.read(length)[MESSAGE_HEAD.size :]
                data = self._chunk(chunk)
            _, length = RECORD_HEAD.unpack_from(data, offset)
            start = offset + RECORD_HEAD.size
            return data[start + MESSAGE_HEAD.size : start + length]
        except _BROKEN as error:
            raise BrokenFileError(
                f"{self.path} is broken at message {index} of {channel.topic}: {_text(error)}."
            ) from error

    def in_file_order(
        self, channels: Iterable[ChannelInfo]
    ) -> Iterator[tuple[ChannelInfo, int, bytes]]:
        """The messages of several channels as (channel, index, payload), each chunk read once."""
        messages: list[tuple[int, int, ChannelInfo, int]] = []
        for channel in channels:
            table = self.tables[channel.id]
            rows = zip(table.chunk.tolist(), table.offset.tolist(), strict=True)
            messages += [(chunk, offset, channel, i) for i, (chunk, offset) in enumerate(rows)]
        for _, _, channel, index in sorted(messages, key=lambda message: message[:2]):
            yield channel, index, self.message(channel, index)

    def close(self) -> None:
        """Close the file."""
        with self._lock:
            self._stream.close()
            self._chunks.clear()

    def _chunk(self, start: int) -> bytes:
        if start in self._chunks:
            self._chunks.move_to_end(start)
            return self._chunks[start]
        self._stream.seek(start + RECORD_HEAD.size)
        data = chunk_data(Chunk.read(ReadDataStream(self._stream)))
        self._chunks[start] = data
        while len(self._chunks) > 1 and sum(map(len, self._chunks.values())) > _CACHED_BYTES:
            self._chunks.popitem(last=False)
        return data

    def _from_index(self) -> Contents | None:
        try:
            return self._indexed()
        except _BROKEN:
            return None  # the summary is missing or broken

    def _indexed(self) -> Contents | None:
        """Contents by the summary, None where it is missing or does not cover all messages."""
        self._stream.seek(0)
        reader = SeekingReader(self._stream)
        summary = reader.get_summary()
        if summary is None or not summary.chunk_indexes or summary.statistics is None:
            return None
        contents = Contents(dict(summary.channels), dict(summary.schemas))
        for index in summary.chunk_indexes:
            for offset in index.message_index_offsets.values():
                self._stream.seek(offset + RECORD_HEAD.size)
                entries = MessageIndex.read(ReadDataStream(self._stream))
                for log_time, inside in entries.records:
                    contents.add_message(
                        entries.channel_id, log_time, index.chunk_start_offset, inside
                    )
        complete = (
            sum(map(len, contents.locations.values())) == summary.statistics.message_count
            and set(contents.locations) <= set(contents.channels)
            and all(c.schema_id in (0, *contents.schemas) for c in contents.channels.values())
            and len(summary.metadata_indexes) == summary.statistics.metadata_count
            and len(summary.attachment_indexes) == summary.statistics.attachment_count
        )
        if not complete:
            return None
        contents.metadata = {m.name: m.metadata for m in reader.iter_metadata()}
        contents.attachments = {a.name: a.data for a in reader.iter_attachments()}
        return contents

    def _scanned(self) -> Contents:
        contents = Contents()
        size = self._stream.seek(0, 2)
        position = len(MAGIC)
        while True:
            self._stream.seek(position)
            head = self._stream.read(RECORD_HEAD.size)
            if len(head) < RECORD_HEAD.size:
                contents.cut_short = True
                return contents
            opcode, length = RECORD_HEAD.unpack(head)
            if opcode == Opcode.DATA_END:
                return contents
            if position + RECORD_HEAD.size + length > size:
                contents.cut_short = True
                return contents
            if opcode in SCANNED:
                try:
                    add_record(contents, opcode, self._stream.read(length), position)
                except _BROKEN:
                    # Records are independent: those after a broken one can still be read.
                    contents.broken_chunks += 1
            position += RECORD_HEAD.size + length


def _opened(path: Path) -> IO[bytes]:
    if path.is_dir():
        raise RecordingError(f"{path} is a folder, and a recording is one .mcap file.")
    try:
        stream = open_file(path)
        head = stream.read(16)
    except OSError as error:
        raise RecordingError(f"{path} cannot be read: {error.strerror}.") from error
    if head.startswith(MAGIC):
        return stream
    stream.close()
    found = next((kind for magic, kind in _OTHER_MAGIC.items() if head.startswith(magic)), None)
    if found is None:
        raise RecordingError(f"{path} is {'not an MCAP file' if head else 'empty'}.")
    raise RecordingError(f"{path} is not an MCAP file but {found}.")


def _text(error: BaseException) -> str:
    return str(error).strip().rstrip(".") or type(error).__name__
