"""MCAP file: channels, tables of their messages, and random access to messages."""

import threading
from collections import OrderedDict
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from typing import TypeVar

import numpy as np
from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.records import Attachment, Metadata
from numpy.typing import NDArray

from recordings.chunk_indexes import ChunkedTable
from recordings.chunks import chunk_data
from recordings.errors import BrokenFileError, RecordingError
from recordings.log_times import log_times
from recordings.mcap_contents import (
    INDEX_HEAD,
    MESSAGE_HEAD,
    UNCHUNKED,
    ChannelInfo,
    MessageTable,
    merged_channels,
    message_table,
)
from recordings.mcap_index import index_of
from recordings.mcap_records import BROKEN, RECORD_HEAD, RecordFile, broken_text

_Record = TypeVar("_Record", Attachment, Metadata)
_CACHED_BYTES = 24 * 2**20  # of decompressed chunks


class McapFile:
    """MCAP file opened for reading; thread-safe.

    The file's own index is used where it is complete. Otherwise (no summary, no message index, cut
    short while recording) the whole file is scanned once to make one.

    Args:
        path: the file.
        salvage: ignore the file's index, scan it, and leave broken chunks out.

    Attributes:
        long: whether its tables are `ChunkedTable`.

    Raises:
        RecordingError: the file does not exist or is not MCAP.
        BrokenFileError: it is broken.
    """

    def __init__(self, path: Path, salvage: bool = False) -> None:
        self.path = path
        self._lock = threading.Lock()
        self._chunks: OrderedDict[int, bytes] = OrderedDict()
        self._file = RecordFile(path)
        try:
            contents, indexes = index_of(self._file, salvage)
            self.channels, numbers = merged_channels(contents)
            self._tables: dict[int, MessageTable | ChunkedTable] = {
                number: message_table(contents, merged)
                if indexes is None
                else indexes.table(merged, self._message_index)
                for number, merged in numbers.items()
            }
        except BROKEN as error:
            self._file.close()
            raise BrokenFileError(f"{path} is a broken MCAP file: {broken_text(error)}.") from error
        self.long = indexes is not None
        self.cut_short = contents.cut_short
        self.broken_chunks = contents.broken_chunks
        self._metadata = contents.metadata
        self._attachments = contents.attachments

    def table(self, channel: ChannelInfo) -> MessageTable | ChunkedTable:
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
        with self._in_words(channel, index):
            chunk, offset = self._tables[channel.id].place(index)
            with self._lock:
                if chunk == UNCHUNKED:
                    self._file.check_open()
                    return self._file.record(offset, Opcode.MESSAGE)[MESSAGE_HEAD.size :]
                data = self._chunk(chunk)
            _, length = RECORD_HEAD.unpack_from(data, offset)
            start = offset + RECORD_HEAD.size
            return data[start + MESSAGE_HEAD.size : start + length]

    def piece(self, channel: ChannelInfo, piece: int) -> list[bytes]:
        """Payloads of the messages of a channel in one chunk of a long file, by its piece.

        Raises:
            BrokenFileError, RecordingError: as in `message`.
        """
        table = self._tables[channel.id]
        assert isinstance(table, ChunkedTable)
        with self._in_words(channel, int(table.first[piece])):
            offsets = table.entries(piece)[:, 1].tolist()
            with self._lock:
                data = self._chunk(table.chunk_start(piece))
            begin = RECORD_HEAD.size + MESSAGE_HEAD.size
            ends = [at + RECORD_HEAD.size + RECORD_HEAD.unpack_from(data, at)[1] for at in offsets]
            return [data[at + begin : end] for at, end in zip(offsets, ends, strict=True)]

    def log_times(self, channels: Sequence[ChannelInfo]) -> list[NDArray[np.int64]]:
        """Log times (N,) of all messages of several channels, without reading any of them.

        Raises:
            BrokenFileError: the file's index is broken.
        """
        tables = [self._tables[channel.id] for channel in channels]
        chunked = [table for table in tables if isinstance(table, ChunkedTable)]
        if len(chunked) < len(tables):
            return [table.log_time for table in tables]
        try:
            with self._lock:
                return log_times(chunked, self._file.content)
        except BROKEN as error:
            raise BrokenFileError(f"{self.path} is broken: {broken_text(error)}.") from error

    def _message_index(self, offset: int, length: int) -> bytes:
        """Content of the message index at an offset; ValueError unless it has that length."""
        with self._lock:
            self._file.check_open()
            head = RECORD_HEAD.size
            record = self._file.content(offset, head + length)
        if RECORD_HEAD.unpack_from(record) != (Opcode.MESSAGE_INDEX, length):
            raise ValueError("a message index is not where it should be")
        if INDEX_HEAD.unpack_from(record, head)[1] != length - INDEX_HEAD.size:
            raise ValueError("a message index does not have the length that it says")
        return record[head:]

    @contextmanager
    def _in_words(self, channel: ChannelInfo, index: int) -> Iterator[None]:
        """Context that turns errors of reading a message into those of `message`."""
        try:
            yield
        except OSError as error:
            raise RecordingError(f"{self.path} cannot be read: {error.strerror}.") from error
        except BROKEN as error:
            number = self._tables[channel.id].number_of(index)
            place = f"message {number} of {channel.topic}"
            text = f"{self.path} is broken at {place}: {broken_text(error)}."
            raise BrokenFileError(text) from error

    def attachment(self, name: str) -> bytes | None:
        """Content of an attachment; None where there is none, or it cannot be read."""
        found = self._small_record(self._attachments.get(name), Attachment.read)
        return None if found is None else found.data

    def metadata(self, name: str) -> dict[str, str] | None:
        """A metadata record; None where there is none, or it cannot be read."""
        found = self._small_record(self._metadata.get(name), Metadata.read)
        return None if found is None else found.metadata

    def _small_record(
        self, place: tuple[int, int] | None, read: Callable[[ReadDataStream], _Record]
    ) -> _Record | None:
        if place is None:
            return None
        try:
            with self._lock:
                content = self._file.content(*place)
            return read(ReadDataStream(BytesIO(content)))
        except BROKEN:
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
        tables = [self._tables[channel.id].whole() for channel in channels]
        starts = [np.zeros((len(table), size), dtype=np.uint8) for table in tables]
        whole = [np.zeros(len(table), dtype=bool) for table in tables]
        chunk = np.concatenate([table.chunk for table in tables] or [np.zeros(0, np.int64)])
        of = np.repeat(np.arange(len(tables)), [len(table) for table in tables])
        row = np.concatenate([np.arange(len(table)) for table in tables] or [chunk])
        order = np.argsort(chunk, kind="stable")
        for group in np.split(order, np.flatnonzero(np.diff(chunk[order])) + 1):
            for n in np.unique(of[group]).tolist():
                rows = row[group[of[group] == n]]
                found = self._starts(channels[n], tables[n], rows, size)
                starts[n][rows], whole[n][rows] = found
        return list(zip(starts, whole, strict=True))

    def _starts(
        self, channel: ChannelInfo, table: MessageTable, rows: NDArray[np.int64], size: int
    ) -> tuple[NDArray[np.uint8], NDArray[np.bool_]]:
        """First bytes of some messages of a channel, all in the same chunk or in none."""
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
            self._file.close()
            self._chunks.clear()

    def _chunk(self, start: int) -> bytes:
        self._file.check_open()
        if start in self._chunks:
            self._chunks.move_to_end(start)
            return self._chunks[start]
        data = chunk_data(self._file.record(start, Opcode.CHUNK))
        self._chunks[start] = data
        while len(self._chunks) > 1 and sum(map(len, self._chunks.values())) > _CACHED_BYTES:
            self._chunks.popitem(last=False)
        return data


def _gather(data: NDArray[np.uint8], at: NDArray[np.int64], size: int) -> NDArray[np.uint8]:
    """So many bytes (N, size) from each of several places, cut short at the end of the data."""
    places = at[:, None] + np.arange(size)
    return data[np.minimum(places, len(data) - 1)] if len(data) else np.zeros(places.shape, "u1")
