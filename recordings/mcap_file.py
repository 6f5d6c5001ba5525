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

from recordings.chunks import chunk_data
from recordings.errors import BrokenFileError, RecordingError
from recordings.mcap_contents import (
    MESSAGE_HEAD,
    UNCHUNKED,
    ChannelInfo,
    MessageTable,
    merged_channels,
)
from recordings.mcap_index import index_of
from recordings.mcap_records import BROKEN, RECORD_HEAD, RecordFile, broken_text

_Record = TypeVar("_Record", Attachment, Metadata)
_CACHED_BYTES = 64 * 2**20  # of decompressed chunks


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
        self._file = RecordFile(path)
        try:
            contents = index_of(self._file, salvage)
            self.channels, self._tables = merged_channels(contents)
        except BROKEN as error:
            self._file.close()
            raise BrokenFileError(f"{path} is a broken MCAP file: {broken_text(error)}.") from error
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
                    self._file.check_open()
                    return self._file.record(offset, Opcode.MESSAGE)[MESSAGE_HEAD.size :]
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
        except BROKEN as error:
            number = self._tables[channel.id].number[index]
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
