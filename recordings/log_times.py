"""Log times of all messages of some topics of a long file, from its message indexes alone."""

from collections.abc import Callable, Sequence

import numpy as np
from mcap.opcode import Opcode
from numpy.typing import NDArray

from recordings.chunk_indexes import BEFORE_PAIRS, PAIR, ChunkedTable
from recordings.mcap_contents import LATEST

_Rows = NDArray[np.int64]
_AT_ONCE = 256
"""Chunks whose message indexes are in memory at a time."""
_LENGTH_AT = 11  # of the bytes of the pairs, after opcode, length and channel


def log_times(tables: Sequence[ChunkedTable], read: Callable[[int, int], bytes]) -> list[_Rows]:
    """Log times (N,) in nanoseconds of the messages of several topics.

    The message indexes of a chunk lie side by side, and are read at once.

    Args:
        tables: of the topics.
        read: gives bytes of the file, by their offset and number.

    Raises:
        ValueError: the file is broken.
    """
    chunk = np.concatenate([table.chunk_of for table in tables])
    offset = np.concatenate([table.index_offset for table in tables])
    count = np.concatenate([np.diff(table.first) for table in tables])
    # Messages of the first table come first, and so on.
    first = np.concatenate([[0], np.cumsum(count)])
    times = np.zeros(first[-1], np.int64)
    order = np.argsort(chunk, kind="stable")
    chunks = np.unique(chunk)
    for begin in chunks[::_AT_ONCE].tolist():
        end = chunks[np.searchsorted(chunks, begin) :][:_AT_ONCE][-1]
        low, high = np.searchsorted(chunk[order], [begin, end + 1])
        rows = order[low:high]
        found = _of_some(chunk[rows], offset[rows], count[rows], read)
        starts = np.repeat(first[rows], count[rows])
        times[starts + _within(count[rows])] = found
    return [
        _sorted(table, part)
        for table, part in zip(
            tables, np.split(times, np.cumsum([len(table) for table in tables])[:-1]), strict=True
        )
    ]


def _of_some(chunk: _Rows, offset: _Rows, count: _Rows, read: Callable[[int, int], bytes]) -> _Rows:
    """Log times in several message indexes, one after the other; those of a chunk are together."""
    starts = np.flatnonzero(np.diff(chunk, prepend=-1))
    ends = offset + BEFORE_PAIRS + PAIR * count
    low, high = np.minimum.reduceat(offset, starts), np.maximum.reduceat(ends, starts)
    blocks = [read(a, b - a) for a, b in zip(low.tolist(), high.tolist(), strict=True)]
    data = np.frombuffer(b"".join(blocks), np.uint8)
    if len(data) != (high - low).sum():
        raise ValueError("the file is shorter than it was")
    moved = np.cumsum(high - low) - high  # from an offset in the file to one in the data
    at = offset + np.repeat(moved, np.diff(starts, append=len(chunk)))
    said = _numbers(data, at + _LENGTH_AT, "<u4")
    if (data[at] != Opcode.MESSAGE_INDEX).any() or (said != PAIR * count).any():
        raise ValueError("a message index is not where it should be")
    pairs = np.repeat(at + BEFORE_PAIRS, count) + PAIR * _within(count)
    return np.minimum(_numbers(data, pairs, "<u8"), LATEST).astype(np.int64)


def _sorted(table: ChunkedTable, times: _Rows) -> _Rows:
    """Log times in the order of the table: increasing in each piece."""
    if (np.diff(times) >= 0).all():
        return times
    piece = np.repeat(np.arange(table.pieces), np.diff(table.first))
    return times[np.lexsort((times, piece))]


def _within(count: _Rows) -> _Rows:
    """0, 1, 2 ... for each of several counts, one after the other."""
    return np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)


def _numbers(data: NDArray[np.uint8], at: _Rows, kind: str) -> NDArray[np.unsignedinteger]:
    """Numbers at several places of the data."""
    size = np.dtype(kind).itemsize
    return data[at[:, None] + np.arange(size)].view(kind).ravel()
