"""What a long recording says around a frame, read where it is asked for."""

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from recordings.chunk_indexes import ChunkedTable
from recordings.decoding import Decoder
from recordings.errors import BrokenFileError
from recordings.frame_table import FrameTable
from recordings.layouts import Samples, samples_of
from recordings.mcap_contents import ChannelInfo
from recordings.mcap_file import McapFile
from recordings.message_kinds import Kind, Name
from recordings.tracks import Stamps

LONG_TOPIC = 20_000
"""Messages of a topic in a long file, from which on they are decoded around frames."""
_FEW_CHUNKS = 64  # that may be read at opening
BLOCK = 8
"""Frames that are computed together."""
_APART = 8  # chunks in which the readings of a block may lie
_ENDS = 3  # chunks at the beginning and at the end, from which a topic is known
_KEPT = 24  # chunks of a topic whose samples are kept
_STEPS = (1, 2, 4, 8)  # chunks by which the search for further samples goes on


class Column:
    """Values at the frames of a long recording, computed where they are asked for.

    Args:
        at: gives the value at a frame.
        known: (K,) whether it is known, by the first and the last sample in the file.
        ends: (N,) numbers in the first and the last chunks.
    """

    def __init__(
        self,
        at: Callable[[int], NDArray[np.float64] | np.float64],
        known: NDArray[np.bool_],
        ends: NDArray[np.float64] | None = None,
    ) -> None:
        self._at, self.known = at, known
        self.ends = np.zeros(0) if ends is None else ends

    def __len__(self) -> int:
        return len(self.known)

    def __getitem__(self, k: int) -> Any:  # noqa: ANN401 (an array or a number)
        return self._at(k)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:  # noqa: ANN401
        """Values at all frames: the whole file is read."""
        return np.array([self._at(k) for k in range(len(self))], dtype=dtype)


def known_at(values: NDArray[np.float64] | Column) -> NDArray[np.bool_]:
    """(K,) whether numbers at the frames are known."""
    return values.known if isinstance(values, Column) else np.isfinite(values)


class FramePlaces:
    """Chunks in which the readings of frames lie.

    Args:
        file: of the recording, a long one.
        decoder: of the file.
        table: its frames.
        channels: of its sensors.
    """

    def __init__(
        self, file: McapFile, decoder: Decoder, table: FrameTable, channels: list[ChannelInfo]
    ) -> None:
        self.file, self.decoder, self.stamps = file, decoder, table.stamps
        self.chunk = np.zeros(len(table.stamps), np.int64)
        missing = np.ones(len(table.stamps), bool)
        for s, channel in enumerate(channels):
            here = np.flatnonzero(missing & (table.message[:, s] >= 0))
            messages = file.table(channel)
            if len(here) and isinstance(messages, ChunkedTable):
                pieces = messages.piece_of(table.message[here, s])
                self.chunk[here] = messages.chunk_of[pieces]
                missing[here] = False
            if not missing.any():
                break

    def block(self, k: int) -> tuple[int, int]:
        """First and last of the frames that are computed together with a frame."""
        first = k - k % BLOCK
        last = min(first + BLOCK, len(self.stamps)) - 1
        chunks = self.chunk[first : last + 1]
        return (first, last) if np.ptp(chunks) <= _APART else (k, k)

    def is_long(self, channel: ChannelInfo) -> bool:
        """Whether a channel is decoded around frames, not as a whole."""
        table = self.file.table(channel)
        many = len(table) >= LONG_TOPIC
        return isinstance(table, ChunkedTable) and (many or table.pieces > _FEW_CHUNKS)


class Nearby:
    """Samples of a topic around the frames that are asked for.

    What a topic gives is taken from its first and last chunks: what is only in between is not used.
    Around frames, samples are looked for in the chunks of their readings and in those beside them,
    and further, up to some 15 chunks, until there is one before and one after. A sample that lies
    out of order further away than those is not found. A broken chunk is left out, and noted.

    Args:
        places: of the frames.
        channel: the topic.
        kind: of its messages.
        number: number of a name, from 0, negative where its samples are left out; asked for new
            names at opening alone.
    """

    def __init__(
        self,
        places: FramePlaces,
        channel: ChannelInfo,
        kind: Kind,
        number: Callable[[Any], int],
    ) -> None:
        table = places.file.table(channel)
        assert isinstance(table, ChunkedTable)
        self._places, self._channel, self._kind, self._table = places, channel, kind, table
        self._numbers: dict[Name, int] = {}
        self._number = lambda name: self._numbers.setdefault(name, number(name))
        ends = [*range(min(_ENDS, table.pieces)), *range(table.pieces - _ENDS, table.pieces)]
        self.ends = Samples.joined(
            [self._read(piece) for piece in sorted({max(piece, 0) for piece in ends})], kind.width
        )
        self._number = lambda name: self._numbers.get(name, -1)
        self._samples = lru_cache(maxsize=_KEPT)(self._read)
        count = int(self.ends.of.max(initial=-1)) + 1
        self.first, self.last = _extremes(self.ends, count)

    def around(self, first_k: int, last_k: int) -> Samples:
        """Samples around frames: for each number one before and one after, where there are any."""
        chunk_of, stamps = self._table.chunk_of, self._places.stamps
        start, end = stamps[first_k], stamps[last_k]
        chunks = self._places.chunk[first_k : last_k + 1]
        low = int(np.searchsorted(chunk_of, chunks.min(), side="left")) - 1
        high = int(np.searchsorted(chunk_of, chunks.max(), side="right")) + 1
        found = Samples.joined([], self._kind.width)
        for step in (*_STEPS, 0):
            low, high = max(low, 0), min(high, self._table.pieces)
            found = self._joined(low, high)
            first, last = _extremes(found, len(self.first))
            before = ((first > start) & (self.first <= start) & (self.last >= start)).any()
            after = ((last < end) & (self.last >= end) & (self.first <= end)).any()
            if not ((before and low > 0) or (after and high < self._table.pieces)):
                break
            low, high = low - step * bool(before), high + step * bool(after)
        return found

    def _joined(self, low: int, high: int) -> Samples:
        return Samples.joined([self._samples(p) for p in range(low, high)], self._kind.width)

    def _read(self, piece: int) -> Samples:
        decoder, start = self._places.decoder, int(self._table.first[piece])
        try:
            payloads = self._places.file.piece(self._channel, piece)
        except BrokenFileError:
            decoder.left_out.add_chunk(self._table.chunk_start(piece))
            return Samples.joined([], self._kind.width)
        return samples_of(
            payloads,
            self._kind,
            lambda index: decoder.fitting(self._channel, start + index),
            self._number,
        )


def _extremes(samples: Samples, count: int) -> tuple[Stamps, Stamps]:
    """First and last stamp of each number; the first after the last where it has none."""
    limits = np.iinfo(np.int64)
    first, last = np.full(count, limits.max), np.full(count, limits.min)
    np.minimum.at(first, samples.of, samples.stamps)
    np.maximum.at(last, samples.of, samples.stamps)
    return first, last
