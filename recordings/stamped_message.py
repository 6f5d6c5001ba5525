"""Serialised messages that are written again and again with new stamps."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from recordings.ros_messages import serialise

_BYTE = 0x1B1B1B1B  # the same in every byte, none of which a stamp of 0 has
_OTHER = _BYTE * 10**9 + _BYTE
_STAMP_BYTES = 8


@dataclass(frozen=True)
class StampedMessage:
    """A serialised message without its stamps.

    Attributes:
        topic: of the message.
        kind: its type, such as "tf2_msgs/msg/TFMessage".
        pieces: its bytes before, between and after the stamps.
    """

    topic: str
    kind: str
    pieces: tuple[bytes, ...]

    def at(self, stamp: int) -> bytes:
        """The message with a stamp in nanoseconds in all its headers."""
        seconds, nanoseconds = divmod(stamp, 10**9)
        return (seconds.to_bytes(4, "little") + nanoseconds.to_bytes(4, "little")).join(self.pieces)


def stamped(topic: str, make: Callable[[int], Any]) -> StampedMessage:
    """Serialise a message once for all stamps.

    Args:
        topic: of the message.
        make: makes the message with a stamp in nanoseconds.
    """
    message = make(0)
    data, other = serialise(message), serialise(make(_OTHER))
    # Where the two differ is a stamp.
    changed = np.frombuffer(data, np.uint8) != np.frombuffer(other, np.uint8)
    places = np.flatnonzero(changed)[::_STAMP_BYTES].tolist()
    starts = [0, *(place + _STAMP_BYTES for place in places)]
    pieces = [data[a:b] for a, b in zip(starts, [*places, len(data)], strict=True)]
    return StampedMessage(topic, message.__msgtype__, tuple(pieces))
