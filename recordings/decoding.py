"""Decoding of ROS 2 messages (CDR) by the schemas in the file."""

from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from recordings.chunk_indexes import ChunkedTable
from recordings.chunks import LARGEST_RECORD
from recordings.errors import BrokenFileError, MisfitError, RecordingError
from recordings.left_out import LeftOut
from recordings.mcap_contents import ChannelInfo
from recordings.mcap_file import McapFile
from recordings.message_types import misfit
from recordings.stamp_index import STAMP_INDEX, unpack

if TYPE_CHECKING:
    from rosbags.typesys.store import Typestore

_LARGEST_SCHEMA = 2**15
"""Bytes; the standard types with all that they use have some thousand."""
_STORES = 64  # schemas whose types are kept; files have the same few
_STAMP_END = 12
"""Bytes of a message up to the end of its header's stamp."""
_TRIED = 100
"""First messages of a topic that are tried until one fits its type."""
_TRIED_CHUNKS = 16
"""Chunks that they may lie in."""
_SAMPLED, _LARGEST_ERROR = 8, 0.05
"""Chunks whose stamps tell how they differ from times of arrival, and the share of the period that
this difference may vary by."""
_MOST_BYTES = {"sensor_msgs/Image": LARGEST_RECORD, "sensor_msgs/JointState": 2**20}
_MOST_BYTES_OF_OTHERS = 2**24
"""Bytes of a message: what is decoded element by element takes a hundred times as much."""


class Decoder:
    """Decoder of the messages of one file.

    Args:
        file: of the channels and their schemas.

    Attributes:
        left_out: messages that do not fit their types.
        has_stamp_index: whether the file has an index of header stamps.
        doubted_index: whether that is no index, or has other stamps than the messages.
        arrival_error: seconds by which stamps in a sample differ from those used, where times of
            arrival serve; None where they do not.
    """

    def __init__(self, file: McapFile) -> None:
        self._file = file
        self._stamps: dict[int, NDArray[np.int64]] = {}
        self.left_out = LeftOut()
        self.arrival_error: float | None = None
        index = file.attachment(STAMP_INDEX)
        self._stamp_index: Mapping[str, NDArray[np.int64]] = (
            unpack(index, file.message_count) if index is not None else {}
        )
        self.has_stamp_index = bool(self._stamp_index)
        self.doubted_index = index is not None and not self._stamp_index

    def can_decode(self, channel: ChannelInfo) -> bool:
        """Whether the encoding of a channel's messages is supported."""
        return channel.encoding == "cdr" and channel.schema_encoding in ("ros2msg", "ros2idl")

    def misfit(self, channel: ChannelInfo) -> str:
        """Why a channel's schema is not what its name says, "" where it is."""
        if len(channel.schema_data) > _LARGEST_SCHEMA:
            return f"its schema has {len(channel.schema_data)} bytes, too many"
        try:
            return misfit(_store_of(channel), channel.schema_name)
        except Exception:  # rosbags' parser can raise any error on a broken schema
            return "its schema cannot be read"

    def decode(self, channel: ChannelInfo, index: int) -> Any:  # noqa: ANN401 (the schema's type)
        """Decode a channel's message.

        Raises:
            MisfitError: the message does not fit its schema.
            BrokenFileError: the file is broken there.
        """
        data = self._file.message(channel, index)
        if len(data) > (most := _most_bytes(channel.schema_name)):
            raise MisfitError(f"it has {len(data)} bytes, more than {most}")
        try:
            return _store_of(channel).deserialize_cdr(data, channel.schema_name)
        except Exception as error:  # rosbags' generated code can raise any error on broken bytes
            raise MisfitError(f"it does not fit the type {channel.schema_name}") from error

    def count(self, channel: ChannelInfo) -> int:
        """Number of a channel's messages."""
        return len(self._file.table(channel))

    def payloads(self, channel: ChannelInfo, indices: range) -> list[bytes]:
        """Bytes of some of a channel's messages; BrokenFileError where the file is broken there."""
        return [self._file.message(channel, index) for index in indices]

    def fitting(self, channel: ChannelInfo, index: int) -> Any | None:  # noqa: ANN401
        """Decode a message; None, and a note in `left_out`, where it does not fit its type."""
        try:
            return self.decode(channel, index)
        except MisfitError as error:
            self.leave_out(channel, index, str(error))
            return None

    def readable(self, channel: ChannelInfo, index: int) -> Any | None:  # noqa: ANN401
        """As `fitting`, and also None where the file is broken."""
        try:
            return self.fitting(channel, index)
        except BrokenFileError:
            table = self._file.table(channel)
            if isinstance(table, ChunkedTable):
                self.left_out.add_chunk(table.chunk_start(table.piece_of_row(index)))
            else:
                self.leave_out(channel, index, "the file is broken there")
            return None

    def leave_out(self, channel: ChannelInfo, index: int, reason: str) -> None:
        """Note in `left_out` that a message is not used."""
        number = self._file.table(channel).number_of(index)
        self.left_out.add(channel.topic, number, reason)

    def first(self, channel: ChannelInfo) -> Any:  # noqa: ANN401
        """The first message of a channel that fits its type; None where none of some does."""
        return next(self.first_messages(channel, _TRIED), None)

    def first_messages(self, channel: ChannelInfo, count: int) -> Iterator[Any]:
        """Those of the first messages of a channel that fit its type; none is noted."""
        table = self._file.table(channel)
        for index in range(min(count, table.within_chunks(_TRIED_CHUNKS))):
            with suppress(MisfitError):
                yield self.decode(channel, index)

    def messages(self, channel: ChannelInfo) -> Iterator[Any]:
        """All messages of a channel that fit its type, decoded one by one."""
        for index in range(len(self._file.table(channel))):
            if (message := self.fitting(channel, index)) is not None:
                yield message

    def header_stamps(self, channel: ChannelInfo) -> NDArray[np.int64]:
        """Header stamps (N,) in nanoseconds of all messages of a channel whose type has a header.

        Our own files have them in an attachment. In others only the first bytes of each message
        are read, without decoding it.
        """
        if channel.id not in self._stamps:
            indexed = self._stamp_index.get(channel.topic)
            if indexed is not None and self._is_true(indexed, channel):
                self._stamps[channel.id] = indexed
            else:
                self.doubted_index |= channel.topic in list(self._stamp_index)
                self.read_stamps([channel])
        return self._stamps[channel.id]

    def _is_true(self, indexed: NDArray[np.int64], channel: ChannelInfo) -> bool:
        """Whether stamps of the index are as many as a channel's messages, and those of some."""
        count = len(self._file.table(channel))
        if len(indexed) != count:
            return False
        try:
            middle = 0 if self._file.long else count // 2  # which opening a long file does not read
            looked_at = sorted({0, middle, count - 1}) if count else []
            payloads = [self._file.message(channel, index) for index in looked_at]
        except RecordingError:
            return False
        if any(len(payload) < _STAMP_END for payload in payloads):
            return False
        starts = np.array([list(payload[:_STAMP_END]) for payload in payloads], dtype=np.uint8)
        return bool((_stamps(starts.reshape(-1, _STAMP_END)) == indexed[looked_at]).all())

    def read_stamps(self, channels: Iterable[ChannelInfo]) -> None:
        """Read the header stamps of several channels at once and cache them for `header_stamps`.

        Messages too short for a header are removed from the file's tables. In a long file the
        times of arrival serve, moved by the difference that a sample of the messages shows, where
        it is nearly the same in all of the sample; see `arrival_error`.
        """
        channels = list(channels)
        if self._file.long:
            channels = self._without_arrivals(channels)
        for channel, (starts, whole) in zip(
            channels, self._file.starts(channels, _STAMP_END), strict=True
        ):
            short = np.flatnonzero(~whole).tolist()
            for index in short:
                self.leave_out(channel, index, "it is too short for a header")
            if short:
                self._file.leave_out(channel, short)
            self._stamps[channel.id] = _stamps(starts[whole])

    def _without_arrivals(self, channels: list[ChannelInfo]) -> list[ChannelInfo]:
        """Cache stamps by times of arrival; returns the channels whose headers must be read."""
        unfit: list[ChannelInfo] = []
        for channel, times in zip(channels, self._file.log_times(channels), strict=True):
            late = self._latenesses(channel, times)
            shift = np.int64(np.median(late)) if len(late) else np.int64(0)
            error = float(np.abs(late - shift).max()) if len(late) else np.inf
            if error <= _LARGEST_ERROR * float(np.median(np.diff(times))):
                self._stamps[channel.id] = times + shift
                self.arrival_error = max(self.arrival_error or 0.0, error * 1e-9)
            else:
                unfit.append(channel)
        return unfit

    def _latenesses(self, channel: ChannelInfo, times: NDArray[np.int64]) -> NDArray[np.int64]:
        """Header stamps minus times of arrival of messages from all over a long file."""
        table = self._file.table(channel)
        assert isinstance(table, ChunkedTable)
        late: list[NDArray[np.int64]] = []
        for piece in np.unique(np.linspace(0, table.pieces - 1, _SAMPLED).astype(int)).tolist():
            with suppress(BrokenFileError):
                starts = [payload[:_STAMP_END] for payload in self._file.piece(channel, piece)]
                if all(len(start) == _STAMP_END for start in starts):
                    bytes_ = np.frombuffer(b"".join(starts), np.uint8).reshape(-1, _STAMP_END)
                    late.append(_stamps(bytes_) - times[table.first[piece] :][: len(starts)])
        return np.concatenate(late) if late else np.zeros(0, np.int64)


@lru_cache(maxsize=_STORES)
def _store(schema_name: str, encoding: str, schema: bytes) -> "Typestore":
    """Types of a schema with all that it uses; each channel may define a type in its own way."""
    from rosbags.typesys import Stores, get_types_from_idl, get_types_from_msg, get_typestore

    text = schema.decode("utf-8")
    if encoding == "ros2idl":
        types = get_types_from_idl(text)
    else:
        types = get_types_from_msg(text, schema_name)
    store = get_typestore(Stores.EMPTY)
    store.register(types)
    return store


def _most_bytes(schema_name: str) -> int:
    return _MOST_BYTES.get(schema_name.replace("/msg/", "/"), _MOST_BYTES_OF_OTHERS)


def _store_of(channel: ChannelInfo) -> "Typestore":
    return _store(channel.schema_name, channel.schema_encoding, channel.schema_data)


def stamp_of(message: Any) -> int:  # noqa: ANN401 (any message with a header)
    """Header stamp of a decoded message in nanoseconds."""
    stamp = message.header.stamp
    return int(stamp.sec) * 1_000_000_000 + int(stamp.nanosec)


def _stamps(starts: NDArray[np.uint8]) -> NDArray[np.int64]:
    """Header stamps (N,) in nanoseconds by the first bytes (N, `_STAMP_END`) of messages."""
    # CDR: four bytes of encapsulation, the second is the byte order; then sec, nanosec.
    little = np.isin(starts[:, 1], (0x01, 0x07, 0x09, 0x0B))
    seconds, nanoseconds = np.ascontiguousarray(starts[:, 4:8]), np.ascontiguousarray(starts[:, 8:])
    sec = np.where(little, seconds.view("<i4").ravel(), seconds.view(">i4").ravel())
    nanosec = np.where(little, nanoseconds.view("<u4").ravel(), nanoseconds.view(">u4").ravel())
    return sec.astype(np.int64) * 1_000_000_000 + nanosec.astype(np.int64)
