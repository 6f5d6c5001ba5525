"""MCAP file: channels, an index of the messages, and random access to messages."""

import struct
import threading
from collections import OrderedDict
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from typing import IO

import numpy as np
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.reader import SeekingReader
from mcap.records import Attachment, Metadata
from numpy.typing import NDArray
from zstandard import ZstdError

from recordings.chunks import LARGEST_RECORD, chunk_data
from recordings.errors import BrokenFileError, RecordingError
from recordings.mcap_contents import (
    MESSAGE_HEAD,
    RECORD_HEAD,
    SCANNED,
    UNCHUNKED,
    ChannelInfo,
    Contents,
    MessageTable,
    add_record,
    merged_channels,
    record_name,
)
from robot_assets.input_files import open_file

MAGIC = b"\x89MCAP0\r\n"
_OTHER_MAGIC = {
    b"#ROSBAG V2.0": "a ROS 1 bag",
    b"SQLite format 3\0": "an SQLite file, perhaps a ROS 2 bag in that format",
}
_CACHED_BYTES = 64 * 2**20  # of decompressed chunks
_NAME_WITHIN = 4096  # bytes of a record
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
        self._size = self._stream.seek(0, 2)
        try:
            contents = (None if salvage else self._from_index()) or self._scanned()
            self.channels, self._tables = merged_channels(contents)
        except _BROKEN as error:
            self._stream.close()
            raise BrokenFileError(f"{path} is a broken MCAP file: {_text(error)}.") from error
        self.cut_short = contents.cut_short
        self.broken_chunks = contents.broken_chunks
        self._metadata = contents.metadata
        self._attachments = contents.attachments

    def table(self, channel: ChannelInfo) -> MessageTable:
        """Locations of a channel's messages."""
        return self._tables[channel.id]

    @property
    def message_count(self) -> int:
        """Number of messages of all channels."""
        return sum(map(len, self._tables.values()))

    def leave_out(self, channel: ChannelInfo, indices: list[int]) -> None:
        """Remove messages from a channel's table; the later ones move up."""
        self._tables[channel.id] = self._tables[channel.id].without(indices)

    def message(self, channel: ChannelInfo, index: int) -> bytes:
        """Payload of a channel's message, by its index in the channel's table.

        Raises:
            BrokenFileError: the file is broken there.
            RecordingError: the file cannot be read any more, or is closed.
        """
        table = self._tables[channel.id]
        chunk, offset = int(table.chunk[index]), int(table.offset[index])
        with self._in_words(channel, index):
            with self._lock:
                if chunk == UNCHUNKED:
                    self._check_open()
                    return self._record(offset, Opcode.MESSAGE)[MESSAGE_HEAD.size :]
                data = self._chunk(chunk)
            _, length = RECORD_HEAD.unpack_from(data, offset)
            start = offset + RECORD_HEAD.size
            return data[start + MESSAGE_HEAD.size : start + length]

    @contextmanager
    def _in_words(self, channel: ChannelInfo, index: int) -> Iterator[None]:
        """Context that turns errors of reading a message into those of `message`."""
        try:
            yield
        except OSError as error:
            raise RecordingError(f"{self.path} cannot be read: {error.strerror}.") from error
        except _BROKEN as error:
            raise BrokenFileError(
                f"{self.path} is broken at message {index} of {channel.topic}: {_text(error)}."
            ) from error

    def _check_open(self) -> None:
        if self._stream.closed:
            raise RecordingError(f"{self.path} is closed.")

    def attachment(self, name: str) -> bytes | None:
        """Content of an attachment; None where there is none, or it cannot be read."""
        if name not in self._attachments:
            return None
        try:
            return Attachment.read(self._small_record(*self._attachments[name])).data
        except _BROKEN:
            return None

    def metadata(self, name: str) -> dict[str, str] | None:
        """A metadata record; None where there is none, or it cannot be read."""
        if name not in self._metadata:
            return None
        try:
            return Metadata.read(self._small_record(*self._metadata[name])).metadata
        except _BROKEN:
            return None

    def starts(
        self, channels: Sequence[ChannelInfo], size: int
    ) -> list[tuple[NDArray[np.uint8], NDArray[np.bool_]]]:
        """First bytes of all messages of several channels, each chunk read once.

        Returns:
            For each channel (N, size) bytes of the payloads, and (N,) whether a payload has as many
            bytes; the bytes of a shorter one are zero.

        Raises:
            BrokenFileError, RecordingError: as in `message`.
        """
        tables = [self._tables[channel.id] for channel in channels]
        starts = [np.zeros((len(table), size), dtype=np.uint8) for table in tables]
        whole = [np.zeros(len(table), dtype=bool) for table in tables]
        chunk = np.concatenate([table.chunk for table in tables] or [np.zeros(0, np.int64)])
        of = np.repeat(np.arange(len(tables)), [len(table) for table in tables])
        row = np.concatenate([np.arange(len(table)) for table in tables] or [chunk])
        order = np.argsort(chunk, kind="stable")
        for group in np.split(order, np.flatnonzero(np.diff(chunk[order])) + 1):
            for n in np.unique(of[group]).tolist():
                rows = row[group[of[group] == n]]
                found = self._starts(channels[n], rows, size)
                starts[n][rows], whole[n][rows] = found
        return list(zip(starts, whole, strict=True))

    def _starts(
        self, channel: ChannelInfo, rows: NDArray[np.int64], size: int
    ) -> tuple[NDArray[np.uint8], NDArray[np.bool_]]:
        """First bytes of some messages of a channel, all in the same chunk or in none."""
        table = self._tables[channel.id]
        chunk = int(table.chunk[rows[0]])
        if chunk == UNCHUNKED:
            payloads = [self.message(channel, row)[:size] for row in rows.tolist()]
            padded = b"".join(payload.ljust(size, b"\0") for payload in payloads)
            lengths = np.array([len(payload) for payload in payloads])
            return np.frombuffer(padded, np.uint8).reshape(-1, size), lengths == size
        with self._in_words(channel, int(rows[0])), self._lock:
            data = np.frombuffer(self._chunk(chunk), dtype=np.uint8)
        offset = table.offset[rows]
        begin = RECORD_HEAD.size + MESSAGE_HEAD.size
        inside = (offset >= 0) & (offset <= len(data) - begin)
        at = np.where(inside, offset, 0)
        length = _gather(data, at + 1, 8).view("<u8").ravel()
        whole = inside & (at + begin + size <= len(data)) & (length >= MESSAGE_HEAD.size + size)
        found = _gather(data, np.where(whole, at + begin, 0), size)
        found[~whole] = 0
        return found, whole

    def close(self) -> None:
        """Close the file."""
        with self._lock:
            self._stream.close()
            self._chunks.clear()

    def _chunk(self, start: int) -> bytes:
        self._check_open()
        if start in self._chunks:
            self._chunks.move_to_end(start)
            return self._chunks[start]
        data = chunk_data(self._record(start, Opcode.CHUNK))
        self._chunks[start] = data
        while len(self._chunks) > 1 and sum(map(len, self._chunks.values())) > _CACHED_BYTES:
            self._chunks.popitem(last=False)
        return data

    def _record(self, position: int, opcode: int) -> bytes:
        """Content of the record at a position; errors as in `_place` and `_content`."""
        return self._content(*self._place(position, opcode))

    def _place(self, position: int, opcode: int) -> tuple[int, int]:
        """Where the content of a record begins, and its length; ValueError for another kind."""
        self._stream.seek(position)
        found, length = RECORD_HEAD.unpack(self._stream.read(RECORD_HEAD.size))
        if found != opcode:
            raise ValueError(f"a record has the opcode {found} instead of {opcode}")
        return position + RECORD_HEAD.size, length

    def _content(self, start: int, length: int) -> bytes:
        """Bytes of the file; ValueError where it has not as many, or they are too many."""
        if start + length > self._size:
            raise ValueError("a record is longer than the file")
        if length > LARGEST_RECORD:
            raise ValueError(f"a record of {length} bytes is larger than {LARGEST_RECORD}")
        self._stream.seek(start)
        return self._stream.read(length)

    def _small_record(self, start: int, length: int) -> ReadDataStream:
        with self._lock:
            return ReadDataStream(BytesIO(self._content(start, length)))

    def _from_index(self) -> Contents | None:
        try:
            return self._indexed()
        except _BROKEN:
            return None  # the summary is missing or broken

    def _indexed(self) -> Contents | None:
        """Contents by the summary, None where it is missing or does not cover all messages."""
        self._stream.seek(0)
        summary = SeekingReader(self._stream).get_summary()
        if summary is None or not summary.chunk_indexes or summary.statistics is None:
            return None
        contents = Contents(dict(summary.channels), dict(summary.schemas))
        read = 0
        for index in summary.chunk_indexes:
            for offset in index.message_index_offsets.values():
                record = self._record(offset, Opcode.MESSAGE_INDEX)
                read += len(record)
                if read > self._size:
                    return None  # indexes that point to the same records
                contents.add_index(record, index.chunk_start_offset)
        for kind, indexes, into in (
            (Opcode.METADATA, summary.metadata_indexes, contents.metadata),
            (Opcode.ATTACHMENT, summary.attachment_indexes, contents.attachments),
        ):
            for index in indexes:
                into[index.name] = self._place(index.offset, kind)
        complete = (
            contents.message_count == summary.statistics.message_count
            and set(contents.locations) <= set(contents.channels)
            and all(c.schema_id in (0, *contents.schemas) for c in contents.channels.values())
            and len(summary.metadata_indexes) == summary.statistics.metadata_count
            and len(summary.attachment_indexes) == summary.statistics.attachment_count
        )
        return contents if complete else None

    def _scanned(self) -> Contents:
        contents = Contents()
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
            start = position + RECORD_HEAD.size
            if start + length > self._size:
                contents.cut_short = True
                return contents
            try:
                if opcode in SCANNED:
                    add_record(contents, opcode, self._content(start, length), position)
                elif opcode in (Opcode.METADATA, Opcode.ATTACHMENT):
                    name = record_name(opcode, self._content(start, min(length, _NAME_WITHIN)))
                    into = contents.metadata if opcode == Opcode.METADATA else contents.attachments
                    into[name] = start, length
            except _BROKEN:
                # Records are independent: those after a broken one can still be read.
                contents.broken_chunks += 1
            position = start + length


def _gather(data: NDArray[np.uint8], at: NDArray[np.int64], size: int) -> NDArray[np.uint8]:
    """So many bytes (N, size) from each of several places, cut short at the end of the data."""
    places = at[:, None] + np.arange(size)
    return data[np.minimum(places, len(data) - 1)] if len(data) else np.zeros(places.shape, "u1")


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
