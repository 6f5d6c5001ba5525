"""The container: channels, an index of the messages, and messages by their place in it."""

import struct
import threading
from collections import OrderedDict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path
from typing import IO

import numpy as np
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.reader import SeekingReader
from mcap.records import Attachment, Channel, Chunk, MessageIndex, Metadata, Schema
from mcap.stream_reader import get_chunk_data_stream
from numpy.typing import NDArray
from zstandard import ZstdError

from recordings.errors import BrokenFileError, RecordingError

MAGIC = b"\x89MCAP0\r\n"
_OTHER_MAGIC = {
    b"#ROSBAG V2.0": "a ROS 1 bag",
    b"SQLite format 3\0": "an SQLite file, perhaps a ROS 2 bag in that format",
}
_RECORD_HEAD = struct.Struct("<BQ")  # opcode, length of what follows
_MESSAGE_HEAD = struct.Struct("<HIQQ")  # channel, sequence, log time, publish time
_UNCHUNKED = -1
_CACHED_BYTES = 64 * 2**20  # decompressed chunks kept at hand
_LATEST = 2**63 - 1  # log times are unsigned in the file; none is as late as this
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


@dataclass(frozen=True)
class ChannelInfo:
    """A channel of the file: a topic and the type of its messages."""

    id: int
    topic: str
    encoding: str
    schema_name: str
    schema_encoding: str
    schema_data: bytes


@dataclass(frozen=True)
class MessageTable:
    """Where the messages of one channel are, in the order of their log times.

    Attributes:
        log_time: (N,) nanoseconds.
        chunk: (N,) offset of the chunk in the file, -1 where the message is in none.
        offset: (N,) offset of the message record in the decompressed chunk, or in the file.
    """

    log_time: NDArray[np.int64]
    chunk: NDArray[np.int64]
    offset: NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.log_time)


@dataclass
class _Contents:
    """What is gathered while a file is indexed."""

    channels: dict[int, Channel] = field(default_factory=dict)
    schemas: dict[int, Schema] = field(default_factory=dict)
    places: dict[int, list[tuple[int, int, int]]] = field(default_factory=dict)
    metadata: dict[str, dict[str, str]] = field(default_factory=dict)
    attachments: dict[str, bytes] = field(default_factory=dict)
    cut_short: bool = False
    broken_chunks: int = 0

    def add_message(self, channel: int, log_time: int, chunk: int, offset: int) -> None:
        self.places.setdefault(channel, []).append((min(log_time, _LATEST), chunk, offset))


class McapFile:
    """An MCAP file, opened for reading; safe to use from several threads.

    The file's own index is used where it has a complete one. Otherwise (no summary, no message
    index, cut short while recording) the file is read through once to make one.

    Args:
        path: the file.
        salvage: read the file through whatever its index says, and leave broken chunks out.

    Raises:
        RecordingError: the file is not there, or not MCAP.
        BrokenFileError: it is broken.
    """

    def __init__(self, path: Path, salvage: bool = False) -> None:
        self.path = path
        self._lock = threading.Lock()
        self._chunks: OrderedDict[int, bytes] = OrderedDict()
        self._stream = _opened(path)
        try:
            contents = (None if salvage else self._from_index()) or self._scanned()
            self.channels, places = _joined(contents)
            self.tables = {c.id: _table(places[c.id]) for c in self.channels}
        except _BROKEN as error:
            self._stream.close()
            raise BrokenFileError(f"{path} is a broken MCAP file: {_text(error)}.") from error
        self.cut_short = contents.cut_short
        self.broken_chunks = contents.broken_chunks
        self.metadata = contents.metadata
        self.attachments = contents.attachments

    def message(self, channel: ChannelInfo, index: int) -> bytes:
        """The payload of a channel's message, by its index in the channel's table."""
        table = self.tables[channel.id]
        chunk, offset = int(table.chunk[index]), int(table.offset[index])
        try:
            with self._lock:
                if chunk == _UNCHUNKED:
                    self._stream.seek(offset)
                    _, length = _RECORD_HEAD.unpack(self._stream.read(_RECORD_HEAD.size))
                    return self._stream.read(length)[_MESSAGE_HEAD.size :]
                data = self._chunk(chunk)
            _, length = _RECORD_HEAD.unpack_from(data, offset)
            start = offset + _RECORD_HEAD.size
            return data[start + _MESSAGE_HEAD.size : start + length]
        except _BROKEN as error:
            raise BrokenFileError(
                f"{self.path} is broken at message {index} of {channel.topic}: {_text(error)}."
            ) from error

    def in_file_order(
        self, channels: Iterable[ChannelInfo]
    ) -> Iterator[tuple[ChannelInfo, int, bytes]]:
        """The messages of several channels as (channel, index, payload), each chunk read once."""
        places: list[tuple[int, int, ChannelInfo, int]] = []
        for channel in channels:
            table = self.tables[channel.id]
            rows = zip(table.chunk.tolist(), table.offset.tolist(), strict=True)
            places += [(chunk, offset, channel, i) for i, (chunk, offset) in enumerate(rows)]
        for _, _, channel, index in sorted(places, key=lambda place: place[:2]):
            yield channel, index, self.message(channel, index)

    def close(self) -> None:
        """Close the file; nothing can be read from it any more."""
        with self._lock:
            self._stream.close()
            self._chunks.clear()

    def _chunk(self, start: int) -> bytes:
        if start in self._chunks:
            self._chunks.move_to_end(start)
            return self._chunks[start]
        self._stream.seek(start + _RECORD_HEAD.size)
        stream, _ = get_chunk_data_stream(
            Chunk.read(ReadDataStream(self._stream)), validate_crc=True
        )
        data = stream.read(_rest(stream))
        self._chunks[start] = data
        while len(self._chunks) > 1 and sum(map(len, self._chunks.values())) > _CACHED_BYTES:
            self._chunks.popitem(last=False)
        return data

    def _from_index(self) -> _Contents | None:
        try:
            return self._indexed()
        except _BROKEN:
            return None  # cut short before the summary was written, or the summary is broken

    def _indexed(self) -> _Contents | None:
        """Use the summary, None where it is absent or does not cover all messages."""
        self._stream.seek(0)
        reader = SeekingReader(self._stream)
        summary = reader.get_summary()
        if summary is None or not summary.chunk_indexes or summary.statistics is None:
            return None
        contents = _Contents(dict(summary.channels), dict(summary.schemas))
        for index in summary.chunk_indexes:
            for offset in index.message_index_offsets.values():
                self._stream.seek(offset + _RECORD_HEAD.size)
                entries = MessageIndex.read(ReadDataStream(self._stream))
                for log_time, place in entries.records:
                    contents.add_message(
                        entries.channel_id, log_time, index.chunk_start_offset, place
                    )
        complete = (
            sum(map(len, contents.places.values())) == summary.statistics.message_count
            and set(contents.places) <= set(contents.channels)
            and all(c.schema_id in (0, *contents.schemas) for c in contents.channels.values())
            and len(summary.metadata_indexes) == summary.statistics.metadata_count
            and len(summary.attachment_indexes) == summary.statistics.attachment_count
        )
        if not complete:
            return None
        contents.metadata = {m.name: m.metadata for m in reader.iter_metadata()}
        contents.attachments = {a.name: a.data for a in reader.iter_attachments()}
        return contents

    def _scanned(self) -> _Contents:
        contents = _Contents()
        size = self._stream.seek(0, 2)
        position = len(MAGIC)
        while True:
            self._stream.seek(position)
            head = self._stream.read(_RECORD_HEAD.size)
            if len(head) < _RECORD_HEAD.size:
                contents.cut_short = True
                return contents
            opcode, length = _RECORD_HEAD.unpack(head)
            if opcode == Opcode.DATA_END:
                return contents
            if position + _RECORD_HEAD.size + length > size:
                contents.cut_short = True
                return contents
            if opcode in _SCANNED:
                try:
                    _take(contents, opcode, self._stream.read(length), position)
                except _BROKEN:
                    # Records stand by themselves: what comes after a broken one is still good.
                    contents.broken_chunks += 1
            position += _RECORD_HEAD.size + length


_SCANNED = {
    Opcode.SCHEMA,
    Opcode.CHANNEL,
    Opcode.MESSAGE,
    Opcode.CHUNK,
    Opcode.METADATA,
    Opcode.ATTACHMENT,
}


def _take(contents: _Contents, opcode: int, record: bytes, position: int) -> None:
    """Enter one record of the data section; `position` is its offset in the file."""
    stream = ReadDataStream(BytesIO(record))
    if opcode == Opcode.SCHEMA:
        schema = Schema.read(stream)
        contents.schemas[schema.id] = schema
    elif opcode == Opcode.CHANNEL:
        channel = Channel.read(stream)
        contents.channels[channel.id] = channel
    elif opcode == Opcode.MESSAGE:
        channel_id, _, log_time, _ = _MESSAGE_HEAD.unpack_from(record)
        contents.add_message(channel_id, log_time, _UNCHUNKED, position)
    elif opcode == Opcode.METADATA:
        metadata = Metadata.read(stream)
        contents.metadata[metadata.name] = metadata.metadata
    elif opcode == Opcode.ATTACHMENT:
        attachment = Attachment.read(stream)
        contents.attachments[attachment.name] = attachment.data
    elif opcode == Opcode.CHUNK:
        _take_chunk(contents, Chunk.read(stream), position)


def _take_chunk(contents: _Contents, chunk: Chunk, position: int) -> None:
    inner, _ = get_chunk_data_stream(chunk, validate_crc=True)
    data = inner.read(_rest(inner))
    offset = 0
    while offset + _RECORD_HEAD.size <= len(data):
        opcode, length = _RECORD_HEAD.unpack_from(data, offset)
        start = offset + _RECORD_HEAD.size
        if opcode == Opcode.MESSAGE:
            channel_id, _, log_time, _ = _MESSAGE_HEAD.unpack_from(data, start)
            contents.add_message(channel_id, log_time, position, offset)
        elif opcode in (Opcode.SCHEMA, Opcode.CHANNEL):
            _take(contents, opcode, data[start : start + length], position)
        offset = start + length


def _opened(path: Path) -> IO[bytes]:
    if path.is_dir():
        raise RecordingError(f"{path} is a folder, and a recording is one .mcap file.")
    try:
        stream = path.open("rb")
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


def _rest(stream: ReadDataStream) -> int:
    """Bytes left in an in-memory stream; mcap's wrapper reads exact counts only."""
    inner = stream._stream
    position = inner.tell()
    size = inner.seek(0, 2)
    inner.seek(position)
    return size - position


def _channel_info(channel: Channel, contents: _Contents) -> ChannelInfo:
    schema = contents.schemas.get(channel.schema_id)
    return ChannelInfo(
        id=channel.id,
        topic=channel.topic,
        encoding=channel.message_encoding,
        schema_name=schema.name if schema else "",
        schema_encoding=schema.encoding if schema else "",
        schema_data=schema.data if schema else b"",
    )


def _joined(
    contents: _Contents,
) -> tuple[tuple[ChannelInfo, ...], dict[int, list[tuple[int, int, int]]]]:
    """Channels with their messages; several publishers of one topic and type are one channel."""
    channels: dict[tuple[str, str, str], ChannelInfo] = {}
    places: dict[int, list[tuple[int, int, int]]] = {}
    for channel in contents.channels.values():
        info = _channel_info(channel, contents)
        kind = (info.topic, info.encoding, info.schema_name)
        first = channels.setdefault(kind, info)
        places.setdefault(first.id, []).extend(contents.places.get(channel.id, []))
    return tuple(channels.values()), places


def _table(places: list[tuple[int, int, int]]) -> MessageTable:
    columns = np.array(places, dtype=np.int64).reshape(-1, 3)
    columns = columns[np.argsort(columns[:, 0], kind="stable")]
    return MessageTable(columns[:, 0], columns[:, 1], columns[:, 2])


def _text(error: BaseException) -> str:
    return str(error).strip().rstrip(".") or type(error).__name__
