"""Decoding of ROS 2 messages (CDR) by the schemas in the file."""

import struct
import threading
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rosbags.typesys import Stores, get_types_from_idl, get_types_from_msg, get_typestore

from recordings.errors import RecordingError
from recordings.mcap_contents import ChannelInfo
from recordings.mcap_file import McapFile
from recordings.stamp_index import STAMP_INDEX, unpack


class Decoder:
    """Decoder of the messages of one file.

    Args:
        file: of the channels and their schemas.
    """

    def __init__(self, file: McapFile) -> None:
        self._file = file
        self._store = get_typestore(Stores.EMPTY)
        self._known: set[str] = set()
        self._lock = threading.Lock()
        self._stamps: dict[int, NDArray[np.int64]] = {}
        count = sum(map(len, file.tables.values()))
        self._stamp_index = unpack(file.attachments.get(STAMP_INDEX, b""), count)

    def can_decode(self, channel: ChannelInfo) -> bool:
        """Whether the encoding of a channel's messages is supported."""
        return channel.encoding == "cdr" and channel.schema_encoding in ("ros2msg", "ros2idl")

    def decode(self, channel: ChannelInfo, index: int) -> Any:  # noqa: ANN401 (the schema's type)
        """Decode a channel's message.

        Raises:
            RecordingError: the message does not fit its schema.
        """
        data = self._file.message(channel, index)
        try:
            self._register(channel)
            return self._store.deserialize_cdr(data, channel.schema_name)
        except Exception as error:  # rosbags' generated code can raise any error on broken bytes
            raise RecordingError(
                f"{self._file.path} is broken at message {index} of {channel.topic}: "
                f"it does not fit the type {channel.schema_name}."
            ) from error

    def messages(self, channel: ChannelInfo) -> Iterator[Any]:
        """All messages of a channel, decoded one by one; errors as in `decode`."""
        return (self.decode(channel, i) for i in range(len(self._file.tables[channel.id])))

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
                self.read_stamps([channel])
        return self._stamps[channel.id]

    def _is_true(self, indexed: NDArray[np.int64], channel: ChannelInfo) -> bool:
        """Whether stamps of the index are as many as a channel's messages, and those of some."""
        count = len(self._file.tables[channel.id])
        if len(indexed) != count:
            return False
        try:
            return all(
                _stamp(self._file.message(channel, index)) == indexed[index]
                for index in {0, count // 2, count - 1}
                if count
            )
        except (struct.error, RecordingError):
            return False

    def read_stamps(self, channels: Iterable[ChannelInfo]) -> None:
        """Read the header stamps of several channels at once and cache them for `header_stamps`.

        Raises:
            RecordingError: a message is too short for a header.
        """
        channels = list(channels)
        stamps = {c.id: np.zeros(len(self._file.tables[c.id]), np.int64) for c in channels}
        for channel, index, payload in self._file.in_file_order(channels):
            try:
                stamps[channel.id][index] = _stamp(payload)
            except struct.error as error:
                raise RecordingError(
                    f"{self._file.path} is broken: a message of {channel.topic} is too short."
                ) from error
        self._stamps |= stamps

    def _register(self, channel: ChannelInfo) -> None:
        with self._lock:
            if channel.schema_name in self._known:
                return
            text = channel.schema_data.decode("utf-8")
            if channel.schema_encoding == "ros2idl":
                types = get_types_from_idl(text)
            else:
                types = get_types_from_msg(text, channel.schema_name)
            self._store.register({k: v for k, v in types.items() if k not in self._store.types})
            self._known.add(channel.schema_name)


def stamp_of(message: Any) -> int:  # noqa: ANN401 (any message with a header)
    """Header stamp of a decoded message in nanoseconds; RecordingError where it has none."""
    try:
        stamp = message.header.stamp
        return int(stamp.sec) * 1_000_000_000 + int(stamp.nanosec)
    except AttributeError as error:
        raise RecordingError("A message has no header stamp where its type should.") from error


def _stamp(payload: bytes) -> int:
    # CDR: four bytes of encapsulation, the second is the byte order; then sec, nanosec.
    little = payload[1:2] in (b"\x01", b"\x07", b"\x09", b"\x0b")
    sec, nanosec = struct.unpack_from("<iI" if little else ">iI", payload, 4)
    return sec * 1_000_000_000 + nanosec
