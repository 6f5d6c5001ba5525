"""Contents of an MCAP file: its records, and tables of its messages."""

import struct
from dataclasses import dataclass, field
from io import BytesIO

import numpy as np
from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, Chunk, Metadata, Schema
from mcap.stream_reader import get_chunk_data_stream
from numpy.typing import NDArray

RECORD_HEAD = struct.Struct("<BQ")
"""Opcode, and length of the content."""
MESSAGE_HEAD = struct.Struct("<HIQQ")
"""Channel, sequence, log time, publish time."""
UNCHUNKED = -1
_LATEST = 2**63 - 1  # log times are unsigned in the file, and signed here


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
class Contents:
    """Records of a file, collected while it is indexed.

    `locations` holds (log time, chunk, offset) of the messages of each channel.
    """

    channels: dict[int, Channel] = field(default_factory=dict)
    schemas: dict[int, Schema] = field(default_factory=dict)
    locations: dict[int, list[tuple[int, int, int]]] = field(default_factory=dict)
    metadata: dict[str, dict[str, str]] = field(default_factory=dict)
    attachments: dict[str, bytes] = field(default_factory=dict)
    cut_short: bool = False
    broken_chunks: int = 0

    def add_message(self, channel: int, log_time: int, chunk: int, offset: int) -> None:
        """Add the location of a message."""
        self.locations.setdefault(channel, []).append((min(log_time, _LATEST), chunk, offset))


SCANNED = {
    Opcode.SCHEMA,
    Opcode.CHANNEL,
    Opcode.MESSAGE,
    Opcode.CHUNK,
    Opcode.METADATA,
    Opcode.ATTACHMENT,
}
"""Records of the data section that are read."""


def add_record(contents: Contents, opcode: int, record: bytes, position: int) -> None:
    """Add one record of the data section; `position` is its offset in the file."""
    stream = ReadDataStream(BytesIO(record))
    if opcode == Opcode.SCHEMA:
        schema = Schema.read(stream)
        contents.schemas[schema.id] = schema
    elif opcode == Opcode.CHANNEL:
        channel = Channel.read(stream)
        contents.channels[channel.id] = channel
    elif opcode == Opcode.MESSAGE:
        channel_id, _, log_time, _ = MESSAGE_HEAD.unpack_from(record)
        contents.add_message(channel_id, log_time, UNCHUNKED, position)
    elif opcode == Opcode.METADATA:
        metadata = Metadata.read(stream)
        contents.metadata[metadata.name] = metadata.metadata
    elif opcode == Opcode.ATTACHMENT:
        attachment = Attachment.read(stream)
        contents.attachments[attachment.name] = attachment.data
    elif opcode == Opcode.CHUNK:
        _add_chunk(contents, Chunk.read(stream), position)


def _add_chunk(contents: Contents, chunk: Chunk, position: int) -> None:
    data = chunk_data(chunk)
    offset = 0
    while offset + RECORD_HEAD.size <= len(data):
        opcode, length = RECORD_HEAD.unpack_from(data, offset)
        start = offset + RECORD_HEAD.size
        if opcode == Opcode.MESSAGE:
            channel_id, _, log_time, _ = MESSAGE_HEAD.unpack_from(data, start)
            contents.add_message(channel_id, log_time, position, offset)
        elif opcode in (Opcode.SCHEMA, Opcode.CHANNEL):
            add_record(contents, opcode, data[start : start + length], position)
        offset = start + length


def chunk_data(chunk: Chunk) -> bytes:
    """Decompressed records of a chunk; its CRC is checked."""
    stream, length = get_chunk_data_stream(chunk, validate_crc=True)
    return stream.read(length)


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


def merged_channels(
    contents: Contents,
) -> tuple[tuple[ChannelInfo, ...], dict[int, list[tuple[int, int, int]]]]:
    """Channels with the locations of their messages; those of one topic and type are merged."""
    channels: dict[tuple[str, str, str], ChannelInfo] = {}
    locations: dict[int, list[tuple[int, int, int]]] = {}
    for channel in contents.channels.values():
        info = _channel_info(channel, contents)
        kind = (info.topic, info.encoding, info.schema_name)
        first = channels.setdefault(kind, info)
        locations.setdefault(first.id, []).extend(contents.locations.get(channel.id, []))
    return tuple(channels.values()), locations


def message_table(locations: list[tuple[int, int, int]]) -> MessageTable:
    """Make a table of messages at (log time, chunk, offset), in any order."""
    columns = np.array(locations, dtype=np.int64).reshape(-1, 3)
    columns = columns[np.argsort(columns[:, 0], kind="stable")]
    return MessageTable(columns[:, 0], columns[:, 1], columns[:, 2])
