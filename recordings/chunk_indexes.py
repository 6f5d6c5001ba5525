"""Index of a long MCAP file by its chunks: where messages are is read where they are needed."""

import struct
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from mcap.opcode import Opcode
from numpy.typing import NDArray

from recordings.mcap_contents import INDEX_HEAD, LATEST, MessageTable
from recordings.mcap_records import MAGIC, RECORD_HEAD, RecordFile

_Rows = NDArray[np.int64]
_FOOTER = struct.Struct("<QQI")
"""Offset of the summary, offset of its own offsets, CRC."""
_CHUNK = struct.Struct("<QQQQI")
"""First and last log time, offset and length of the chunk, bytes of the offsets that follow."""
_OFFSET = np.dtype([("channel", "<u2"), ("offset", "<u8")])
_SIZES = struct.Struct("<QI")
"""Bytes of the chunk's message indexes, length of the compression's name."""
PAIR = 16
"""Bytes of a log time and an offset."""
BEFORE_PAIRS = RECORD_HEAD.size + INDEX_HEAD.size
"""Bytes of a message index before those."""
_KEPT = 64  # message indexes of a channel


def summary_records(file: RecordFile) -> dict[int, list[bytes]]:
    """Contents of the records of a file's summary by their kinds; empty where it has none.

    Raises:
        One of `BROKEN`: the end of the file is missing or broken.
    """
    end = file.size - len(MAGIC) - RECORD_HEAD.size - _FOOTER.size
    start, _, _ = _FOOTER.unpack(file.record(end, Opcode.FOOTER))
    if start == 0:
        return {}
    data, found, at = file.content(start, end - start), {}, 0
    while at < len(data):
        kind, length = RECORD_HEAD.unpack_from(data, at)
        at += RECORD_HEAD.size
        found.setdefault(kind, []).append(data[at : at + length])
        at += length
    return found


@dataclass(frozen=True)
class ChunkIndexes:
    """Message indexes of a file, one for each channel in each chunk, in the order of the chunks.

    Attributes:
        start: (C,) offset of each chunk in the file.
        channel: (E,) channel of each message index, uint16.
        chunk: (E,) index of its chunk.
        offset: (E,) its offset in the file.
        count: (E,) its number of messages.
        uncompressed: bytes of all chunks.
    """

    start: _Rows
    channel: NDArray[np.uint16]
    chunk: _Rows
    offset: _Rows
    count: _Rows
    uncompressed: int

    @cached_property
    def _by_channel(self) -> _Rows:
        """(E,) message indexes in the order of their channels, and of the chunks in each."""
        return np.argsort(self.channel, kind="stable")

    @cached_property
    def _channels(self) -> NDArray[np.uint16]:
        return self.channel[self._by_channel]

    def counts(self) -> dict[int, int]:
        """{channel: number of messages}."""
        totals = np.bincount(self.channel, weights=self.count)
        return {n: int(total) for n, total in enumerate(totals.tolist()) if total}

    def table(self, channels: Iterable[int], read: Callable[[int, int], bytes]) -> "ChunkedTable":
        """Table of the messages of one or more channels.

        Args:
            channels: that are merged.
            read: gives the content of the message index at an offset in the file, with its length.
        """
        parts = [
            self._by_channel[slice(*np.searchsorted(self._channels, [n, n + 1]))] for n in channels
        ]
        mine = np.sort(np.concatenate(parts))
        return ChunkedTable(self.start, self.chunk[mine], self.offset[mine], self.count[mine], read)


def chunk_indexes(records: Iterable[bytes]) -> ChunkIndexes:
    """Parse the chunk indexes of a summary.

    How many messages a message index holds follows from where the next one begins.

    Raises:
        ValueError, struct.error: they are broken.
    """
    heads, offsets, lengths, size = [], [], [], 0
    ordered = sorted(records, key=lambda record: _CHUNK.unpack_from(record)[2])
    for record in ordered:
        _, _, start, _, length = _CHUNK.unpack_from(record)
        at = _CHUNK.size + length
        in_all, name = _SIZES.unpack_from(record, at)
        _, uncompressed = struct.unpack_from("<QQ", record, at + _SIZES.size + name)
        heads.append((start, length // _OFFSET.itemsize))
        offsets.append(record[_CHUNK.size : at])
        lengths.append(in_all)
        size += uncompressed
    start, entries = np.array(heads, np.int64).reshape(-1, 2).T
    table = np.frombuffer(b"".join(offsets), _OFFSET)
    chunk = np.repeat(np.arange(len(start)), entries)
    offset = np.minimum(table["offset"], LATEST).astype(np.int64)
    channel = table["channel"]
    if (np.diff(offset) < 0).any():
        order = np.lexsort((offset, chunk))
        channel, chunk, offset = channel[order], chunk[order], offset[order]
    first = np.searchsorted(chunk, np.arange(len(start)))
    inside = entries > 0
    ends = np.zeros(len(start), np.int64)
    ends[inside] = offset[first[inside]] + np.array(lengths, np.int64)[inside]
    last = np.append(chunk[1:] != chunk[:-1], True) if len(chunk) else np.zeros(0, bool)
    after = np.where(last, ends[chunk], np.append(offset[1:], 0)) if len(chunk) else offset
    count, rest = np.divmod(after - offset - BEFORE_PAIRS, PAIR)
    if (rest != 0).any() or (count < 0).any():
        raise ValueError("the message indexes of a chunk do not follow each other")
    return ChunkIndexes(start, channel, chunk, offset, count, size)


class ChunkedTable:
    """Locations of the messages of one topic of a long file, read chunk by chunk.

    The messages are in the order of the file's chunks, and in each in the order of log times. A
    piece is what one chunk holds of them.

    Args:
        start: (C,) offset of each chunk in the file.
        chunk: (P,) index of the chunk of each piece.
        offset: (P,) offset of its message index in the file.
        count: (P,) its number of messages.
        read: gives the content of a message index, by its offset and length.

    Attributes:
        chunk_of: (P,) index of the chunk of each piece.
        index_offset: (P,) offset of its message index in the file.
        first: (P + 1,) first message of each piece, and the number of all.
    """

    def __init__(
        self,
        start: _Rows,
        chunk: _Rows,
        offset: _Rows,
        count: _Rows,
        read: Callable[[int, int], bytes],
    ) -> None:
        self._start, self.index_offset, self._read = start, offset, read
        self.chunk_of = chunk
        self.first = np.concatenate([[0], np.cumsum(count)])
        self._entries = lru_cache(maxsize=_KEPT)(self.entries)

    def __len__(self) -> int:
        return int(self.first[-1])

    @property
    def pieces(self) -> int:
        """Number of pieces."""
        return len(self.chunk_of)

    def entries(self, piece: int) -> NDArray[np.int64]:
        """Log time and offset in the chunk (N, 2) of each message of a piece.

        Raises:
            ValueError: the file is broken there.
        """
        count = int(self.first[piece + 1] - self.first[piece])
        record = self._read(int(self.index_offset[piece]), INDEX_HEAD.size + count * PAIR)
        pairs = np.frombuffer(record, "<u8", 2 * count, INDEX_HEAD.size).reshape(-1, 2)
        pairs = np.minimum(pairs, LATEST).astype(np.int64)
        times = pairs[:, 0]
        return pairs if (times[1:] >= times[:-1]).all() else pairs[np.argsort(times, kind="stable")]

    def place(self, index: int) -> tuple[int, int]:
        """Offset of a message's chunk in the file, and of the message in it."""
        piece = self.piece_of_row(index)
        return self.chunk_start(piece), int(self._entries(piece)[index - self.first[piece], 1])

    def chunk_start(self, piece: int) -> int:
        """Offset of a piece's chunk in the file."""
        return int(self._start[self.chunk_of[piece]])

    def piece_of_row(self, index: int) -> int:
        """Piece of a message."""
        return int(np.searchsorted(self.first, index, side="right")) - 1

    def piece_of(self, rows: _Rows) -> _Rows:
        """Piece of each of several messages."""
        return np.searchsorted(self.first, rows, side="right") - 1

    def number_of(self, index: int) -> int:
        """Number of a message in the file."""
        return index

    def within_chunks(self, count: int) -> int:
        """How many messages come before those of further chunks than so many."""
        return int(self.first[min(count, self.pieces)])

    @property
    def log_time(self) -> _Rows:
        """(N,) nanoseconds; all message indexes of the topic are read."""
        return self.whole().log_time

    @property
    def offset(self) -> _Rows:
        """(N,) offset of each message in its chunk; all message indexes of the topic are read."""
        return self.whole().offset

    @property
    def chunk(self) -> _Rows:
        """(N,) offset of each message's chunk in the file."""
        return np.repeat(self._start[self.chunk_of], np.diff(self.first))

    def whole(self) -> MessageTable:
        """The table in memory; all message indexes of the topic are read."""
        found = [self.entries(piece) for piece in range(self.pieces)]
        pairs = np.concatenate([np.zeros((0, 2), np.int64), *found])
        times, offsets = np.ascontiguousarray(pairs.T)
        return MessageTable(np.arange(len(self)), times, self.chunk, offsets)

    def without(self, rows: list[int]) -> MessageTable:
        """The table without some of its rows, in memory."""
        return self.whole().without(rows)
