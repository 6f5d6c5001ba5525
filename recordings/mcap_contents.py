"""Contents of an MCAP file: its records, and tables of its messages."""

import struct
from array import array
from dataclasses import dataclass, field
from io import BytesIO

import numpy as np
from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.records import Channel, Schema
from numpy.typing import NDArray

from recordings.chunks import Budget, chunk_data
from recordings.mcap_records import RECORD_HEAD

MESSAGE_HEAD = struct.Struct("<HIQQ")
"""Channel, sequence, log time, publish time."""
UNCHUNKED = -1
INDEX_HEAD = struct.Struct("<HI")
"""Channel, and bytes of the entries."""
LATEST = 2**63 - 1
"""Log times are unsigned in the file, and signed here."""


@dataclass(frozen=True)
class ChannelInfo:
    """Channel of the file: a topic and the type of its messages."""

    id: int
    topic: str
    encoding: str
    schema_name: str
    schema_encoding: str
    schema_data: bytes


@dataclass(frozen=True)
class MessageTable:
    """Locations of the messages of one channel, in the order of their log times.

    Attributes:
        number: (N,) of each message in the file, by which it is named; from 0.
        log_time: (N,) nanoseconds.
        chunk: (N,) offset of the chunk in the file, -1 where the message is in none.
        offset: (N,) offset of the message record in the decompressed chunk, or in the file.
    """

    number: NDArray[np.int64]
    log_time: NDArray[np.int64]
    chunk: NDArray[np.int64]
    offset: NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.log_time)

    def place(self, index: int) -> tuple[int, int]:
        """Offset of a message's chunk in the file, -1 without, and of the message in it."""
        return int(self.chunk[index]), int(self.offset[index])

    def number_of(self, index: int) -> int:
        """Number of a message in the file."""
        return int(self.number[index])

    def whole(self) -> "MessageTable":
        """The table itself, which is in memory."""
        return self

    def within_chunks(self, count: int) -> int:
        """How many messages come before those of further chunks than so many."""
        changes = np.flatnonzero(np.diff(self.chunk))
        return len(self) if len(changes) < count else int(changes[count - 1]) + 1

    def without(self, rows: list[int]) -> "MessageTable":
        """The table without some of its rows."""
        columns = (self.number, self.log_time, self.chunk, self.offset)
        return MessageTable(*(np.delete(column, rows) for column in columns))


@dataclass
class Contents:
    """Records of a file, collected while it is indexed.

    Attributes:
        channels: by their number.
        schemas: by their number.
        locations: {channel: (log time, chunk, offset) of each message, one after the other}.
        metadata: {name: (offset of the record's content in the file, its length)}.
        attachments: likewise.
        cut_short: whether the end of the file is missing.
        broken_chunks: number of records that could not be read.
    """

    channels: dict[int, Channel] = field(default_factory=dict)
    schemas: dict[int, Schema] = field(default_factory=dict)
    locations: dict[int, "array[int]"] = field(default_factory=dict)
    metadata: dict[str, tuple[int, int]] = field(default_factory=dict)
    attachments: dict[str, tuple[int, int]] = field(default_factory=dict)
    cut_short: bool = False
    broken_chunks: int = 0

    @property
    def message_count(self) -> int:
        """Number of messages."""
        return sum(map(len, self.locations.values())) // 3

    def add_message(self, channel: int, log_time: int, chunk: int, offset: int) -> None:
        """Add the location of a message."""
        self._of(channel).extend((min(log_time, LATEST), chunk, offset))

    def add_index(self, record: bytes, chunk: int) -> None:
        """Add a message index: the locations of the messages of one channel in a chunk."""
        channel, length = INDEX_HEAD.unpack_from(record)
        entries = np.frombuffer(record, "<u8", 2 * (length // 16), INDEX_HEAD.size).reshape(-1, 2)
        entries = np.minimum(entries, LATEST).astype(np.int64)
        rows = np.column_stack((entries[:, 0], np.full(len(entries), chunk), entries[:, 1]))
        self._of(channel).frombytes(rows.tobytes())

    def _of(self, channel: int) -> "array[int]":
        return self.locations.setdefault(channel, array("q"))


SCANNED = {Opcode.SCHEMA, Opcode.CHANNEL, Opcode.MESSAGE, Opcode.CHUNK}
"""Records of the data section that are read as a whole when it is scanned."""


def add_record(
    contents: Contents, opcode: int, record: bytes, position: int, budget: Budget | None = None
) -> None:
    """Add one record of the data section.

    Args:
        contents: to add it to.
        opcode: its kind.
        record: its content.
        position: its offset in the file.
        budget: of the file, from which a chunk's size is taken.
    """
    if opcode == Opcode.SCHEMA:
        schema = Schema.read(ReadDataStream(BytesIO(record)))
        contents.schemas[schema.id] = schema
    elif opcode == Opcode.CHANNEL:
        channel = Channel.read(ReadDataStream(BytesIO(record)))
        contents.channels[channel.id] = channel
    elif opcode == Opcode.MESSAGE:
        channel_id, _, log_time, _ = MESSAGE_HEAD.unpack_from(record)
        contents.add_message(channel_id, log_time, UNCHUNKED, position)
    elif opcode == Opcode.CHUNK:
        _add_chunk(contents, chunk_data(record, budget), position)


def record_name(opcode: int, start: bytes) -> str:
    """Name of a metadata or attachment record by the first bytes of its content."""
    # An attachment begins with two times.
    at = 16 if opcode == Opcode.ATTACHMENT else 0
    (length,) = struct.unpack_from("<I", start, at)
    if at + 4 + length > len(start):
        raise ValueError("a record's name is longer than the record")
    return start[at + 4 : at + 4 + length].decode("utf-8")


def _add_chunk(contents: Contents, data: bytes, position: int) -> None:
    offset = 0
    while offset + RECORD_HEAD.size <= len(data):
        opcode, length = RECORD_HEAD.unpack_from(data, offset)
        start = offset + RECORD_HEAD.size
        if opcode == Opcode.MESSAGE:
            channel_id, _, log_time, _ = MESSAGE_HEAD.unpack_from(data, start)
            contents.add_message(channel_id, log_time, position, offset)
        elif opcode in (Opcode.SCHEMA, Opcode.CHANNEL):
            add_record(contents, opcode, data[start : start + length], position)
        elif opcode == 0:
            raise ValueError("a chunk holds records of no kind")
        offset = start + length


def _channel_info(channel: Channel, contents: Contents) -> ChannelInfo:
    schema = contents.schemas.get(channel.schema_id)
    return ChannelInfo(
        id=channel.id,
        topic=channel.topic,
        encoding=channel.message_encoding,
        schema_name=schema.name if schema else "",
        schema_encoding=schema.encoding if schema else "",
        schema_data=schema.data if schema else b"",
    )


def merged_channels(contents: Contents) -> tuple[tuple[ChannelInfo, ...], dict[int, list[int]]]:
    """Channels, those of one topic and type merged into one; and {its number: all numbers}."""
    channels: dict[tuple[str, str, str], ChannelInfo] = {}
    numbers: dict[int, list[int]] = {}
    for channel in contents.channels.values():
        info = _channel_info(channel, contents)
        kind = (info.topic, info.encoding, info.schema_name)
        first = channels.setdefault(kind, info)
        numbers.setdefault(first.id, []).append(channel.id)
    return tuple(channels.values()), numbers


def message_table(contents: Contents, channels: list[int]) -> MessageTable:
    """Table of the messages of one or more channels."""
    locations = array("q")
    for channel in channels:
        locations.extend(contents.locations.get(channel, array("q")))
    return _table(locations)


def _table(locations: "array[int]") -> MessageTable:
    """Table of messages at (log time, chunk, offset), in any order."""
    columns = np.frombuffer(locations.tobytes(), dtype=np.int64).reshape(-1, 3)
    columns = columns[np.argsort(columns[:, 0], kind="stable")]
    number = np.arange(len(columns))
    return MessageTable(number, *(np.ascontiguousarray(column) for column in columns.T))
