"""Types of messages that are read in numbers: what they give, and where it lies in their bytes."""

import struct
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from recordings.decoding import stamp_of

Name = str | tuple[str, str]
"""Name of what a message gives: a joint, or a frame and its parent."""
Field = tuple[Name, int, tuple[float, ...]]
"""Name of what a message gives, its stamp in nanoseconds, and the values."""
_ORIGIN = 4  # CDR aligns from behind the encapsulation
_LITTLE = b"\x00\x01"


@dataclass
class Layout:
    """Places of the numbers in the bytes of a message.

    Attributes:
        names: of what it gives.
        stamps: place of the stamp of each.
        values: place of the first value of each.
        free: (start, end) of further bytes that differ between messages.
    """

    names: list[Name] = field(default_factory=list)
    stamps: list[int] = field(default_factory=list)
    values: list[int] = field(default_factory=list)
    free: list[tuple[int, int]] = field(default_factory=list)


@dataclass(frozen=True)
class Kind:
    """Type of message that gives samples.

    Attributes:
        width: number of values of a sample.
        fields: samples of a decoded message.
        layout: layout of a message, by its bytes; may raise struct.error, ValueError, IndexError.
    """

    width: int
    fields: Callable[[Any], list[Field]]
    layout: Callable[[bytes], Layout]


class _Walk:
    """Walk over the bytes of a message in little-endian CDR."""

    def __init__(self, data: bytes) -> None:
        if data[:2] != _LITTLE:
            raise ValueError("another encoding")
        self._data, self.at = data, _ORIGIN

    def align(self, size: int) -> int:
        """Place of the next value of so many bytes."""
        self.at += -(self.at - _ORIGIN) % size
        return self.at

    def count(self) -> int:
        """The next number of elements."""
        (value,) = struct.unpack_from("<I", self._data, self.align(4))
        self.at += 4
        return value

    def text(self) -> str:
        """The next text."""
        length = self.count()
        self.at += length
        return self._data[self.at - length : self.at].rstrip(b"\0").decode("utf-8")

    def header(self) -> tuple[int, str]:
        """Place of the next header's stamp, and its frame."""
        stamp = self.align(4)
        self.at += 8
        return stamp, self.text()

    def doubles(self, count: int) -> int:
        """Place of the next doubles; ValueError where the message ends before."""
        if count == 0:
            return self.at
        start = self.align(8)
        self.at += 8 * count
        if self.at > len(self._data):
            raise ValueError("the message ends before")
        return start


def _transforms_layout(data: bytes) -> Layout:
    walk, layout = _Walk(data), Layout()
    for _ in range(walk.count()):
        stamp, parent = walk.header()
        layout.names.append(_edge(walk.text(), parent))
        layout.stamps.append(stamp)
        layout.values.append(walk.doubles(7))
    return layout


def _transforms_fields(message: Any) -> list[Field]:  # noqa: ANN401 (a decoded message)
    fields: list[Field] = []
    for stamped in message.transforms:
        t, q = stamped.transform.translation, stamped.transform.rotation
        name = _edge(stamped.child_frame_id, stamped.header.frame_id)
        fields.append((name, stamp_of(stamped), (t.x, t.y, t.z, q.x, q.y, q.z, q.w)))
    return fields


def _edge(child: str, parent: str) -> Name:
    return child.lstrip("/"), parent.lstrip("/")


def _joints_layout(data: bytes) -> Layout:
    walk = _Walk(data)
    stamp, _ = walk.header()
    names = [walk.text() for _ in range(walk.count())]
    positions = walk.count()
    start = walk.doubles(positions)
    names = names[:positions]
    places = [start + 8 * n for n in range(len(names))]
    free = [(start, walk.at)]
    for _ in range(2):  # velocity and effort
        count = walk.count()
        free.append((walk.doubles(count), walk.at))
    return Layout([*names], [stamp] * len(names), places, free)


def _joints_fields(message: Any) -> list[Field]:  # noqa: ANN401
    stamp = stamp_of(message)
    pairs = zip(message.name, message.position, strict=False)
    return [(str(name), stamp, (float(value),)) for name, value in pairs]


def _stamped_layout(width: int) -> Callable[[bytes], Layout]:
    def layout(data: bytes) -> Layout:
        walk = _Walk(data)
        stamp, _ = walk.header()
        return Layout([""], [stamp], [walk.doubles(width)])

    return layout


def _twist_fields(message: Any) -> list[Field]:  # noqa: ANN401
    v, w = message.twist.linear, message.twist.angular
    return [("", stamp_of(message), (v.x, v.y, v.z, w.x, w.y, w.z))]


def _pose_fields(message: Any) -> list[Field]:  # noqa: ANN401
    p, q = message.pose.position, message.pose.orientation
    return [("", stamp_of(message), (p.x, p.y, p.z, q.x, q.y, q.z, q.w))]


TRANSFORMS = Kind(7, _transforms_fields, _transforms_layout)
"""tf2_msgs/TFMessage: translation and quaternion of each (frame, parent)."""
JOINTS = Kind(1, _joints_fields, _joints_layout)
"""sensor_msgs/JointState: position of each joint."""
TWIST = Kind(6, _twist_fields, _stamped_layout(6))
"""geometry_msgs/TwistStamped: linear and angular velocity."""
POSE = Kind(7, _pose_fields, _stamped_layout(7))
"""geometry_msgs/PoseStamped: position and quaternion."""
