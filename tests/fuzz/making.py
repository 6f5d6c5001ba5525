"""Making of hostile recordings by hand: good ones with one thing wrong."""

import struct
import zlib
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from io import BytesIO
from itertools import pairwise
from pathlib import Path

import lz4.frame
import numpy as np
import zstandard

from tests.fuzz.container import Container, read, written
from tests.fuzz.seeds import ARM, arm, seeds
from tests.recordings.foreign import (
    ForeignFile,
    at,
    camera_info,
    image,
    joint_state,
    transforms,
    twist,
)

MB = 2**20
SIGNALLING_NAN = float(np.array(0x7FF0000000000001, dtype=np.uint64).view(np.float64))
"""NumPy warns of an operation on it, which it does not of other NaNs."""


@dataclass(frozen=True)
class Handmade:
    """A hostile recording.

    Attributes:
        write: writes it to a path and returns that.
        said: part of what must be told about it, or of what it is refused with.
    """

    write: Callable[[Path], Path]
    said: str = ""


@lru_cache(maxsize=1)
def arm_file() -> Container:
    """Content of a recording by another writer, of a robot with a sensor."""
    return read(seeds()["arm"])


@lru_cache(maxsize=1)
def our_file() -> Container:
    """Content of a recording by our writer."""
    return read(seeds()["ours"])


def changed(change: Callable[[], Container], said: str = "") -> Handmade:
    """A recording of changed content."""

    def write(path: Path) -> Path:
        path.write_bytes(written(change()))
        return path

    return Handmade(write, said)


def one_bad(
    topic: str, data: bytes = b"\x00\x01", seed: str = "arm", said: str | None = None
) -> Handmade:
    """One message of a topic, the second where there is one, is damaged."""

    def change() -> Container:
        container = read(seeds()[seed])
        indices = [i for i, message in enumerate(container.messages) if message.topic == topic]
        return container.with_message(indices[min(1, len(indices) - 1)], data=data)

    return changed(change, f"of {topic} is left out" if said is None else said)


def schema(kind: str, old: bytes, new: bytes, said: str) -> Handmade:
    """The schema of a type says something else."""

    def change() -> Container:
        found = next(message.schema for message in arm_file().messages if message.kind == kind)
        return arm_file().with_kind(kind, schema=found.replace(old, new, 1))

    return changed(change, said)


def described(description: str, said: str = "") -> Handmade:
    """A robot's description is another one."""
    return Handmade(partial(arm, description=description), said)


def shaped(geometry: str, said: str) -> Handmade:
    """The robot has one more shape, visible and for collisions."""
    shape = f"<visual><geometry>{geometry}</geometry></visual>"
    shape += shape.replace("visual>", "collision>")
    return described(ARM.replace("</link>", f"{shape}</link>", 1), said)


def attached(name: str, data: bytes, said: str = "") -> Handmade:
    """Our recording has another attachment."""

    def change() -> Container:
        return replace(our_file(), attachments=our_file().attachments | {name: data})

    return changed(change, said)


def recorded(said: str = "", **values: str) -> Handmade:
    """Our record of provenance says something else."""

    def change() -> Container:
        return replace(our_file(), metadata={"tofscope": our_file().metadata["tofscope"] | values})

    return changed(change, said)


def eye(
    add: Callable[[ForeignFile], None], said: str = "", stamps: tuple[int, ...] = ()
) -> Handmade:
    """A sensor that sees a wall, and whatever else is added."""

    def write(path: Path) -> Path:
        file = ForeignFile()
        for k, stamp in enumerate(stamps or [k * 66_666_667 for k in range(4)]):
            ranges = np.full((8, 8), 1000, "<u2")
            file.add("/eye/depth", "sensor_msgs/msg/Image", image(stamp, "eye", ranges, "16UC1"), k)
        add(file)
        return file.write(path)

    return Handmade(write, said)


def nothing(file: ForeignFile) -> None:
    """Add nothing."""


def picture(said: str = "", **more: object) -> Handmade:
    """The last image of a sensor is another one."""

    def add(file: ForeignFile) -> None:
        bad = image(5 * 66_666_667, "eye", np.full((8, 8), 1000, "<u2"), "16UC1") | more
        file.add("/eye/depth", "sensor_msgs/msg/Image", bad, 5)

    return eye(add, said)


def camera(said: str, **k: float) -> Handmade:
    """The intrinsics of a sensor are other ones."""

    def add(file: ForeignFile) -> None:
        info = camera_info(0, "eye")
        for name, value in k.items():
            info["k"][{"fx": 0, "cx": 2, "fy": 4, "cy": 5}[name]] = value
        file.add("/eye/camera_info", "sensor_msgs/msg/CameraInfo", info, 0)

    return eye(add, said)


def tree(edges: Callable[[], list[tuple[str, str]]], said: str = "", x: float = 0.0) -> Handmade:
    """A sensor is placed by a tree of fixed frames (parent, child)."""

    def add(file: ForeignFile) -> None:
        poses = [(parent, child, at(x=x)) for parent, child in edges()]
        file.add("/tf_static", "tf2_msgs/msg/TFMessage", transforms(0, poses), 0)

    return eye(add, said)


def line(length: int) -> list[tuple[str, str]]:
    """Edges of a chain of so many frames above the sensor."""
    names = [*(f"f{i}" for i in range(length)), "eye"]
    return list(pairwise(names))


def joints(positions: dict[str, float], said: str = "") -> Handmade:
    """Joints have positions."""

    def add(file: ForeignFile) -> None:
        state = joint_state(0, positions)
        file.add("/joint_states", "sensor_msgs/msg/JointState", state, 0)

    return eye(add, said)


def _packed(compression: str, size: int) -> tuple[bytes, int]:
    """Compressed chunk of one record of zeros, made piece by piece, and its CRC."""
    packed = BytesIO()
    stream = (
        zstandard.ZstdCompressor().stream_writer(packed, size=size, closefd=False)
        if compression == "zstd"
        else lz4.frame.LZ4FrameFile(packed, mode="wb")
    )
    with stream:
        head = b"\x80" + struct.pack("<Q", size - 9)
        stream.write(head)
        crc = zlib.crc32(head)
        for start in range(0, size - 9, MB):
            zeros = bytes(min(MB, size - 9 - start))
            stream.write(zeros)
            crc = zlib.crc32(zeros, crc)
    return packed.getvalue(), crc


def bomb(compression: str, chunks: int, size: int, said: str = "") -> Handmade:
    """Chunks of a few bytes that become large, between the head and the rest of a good file."""

    def write(path: Path) -> Path:
        good = seeds()["arm"]
        packed, crc = _packed(compression, size)
        record = struct.pack("<QQQI", 0, 0, size, crc)
        record += struct.pack("<I", len(compression)) + compression.encode()
        record += struct.pack("<Q", len(packed)) + packed
        chunk = b"\x06" + struct.pack("<Q", len(record)) + record
        after_head = 17 + struct.unpack_from("<Q", good, 9)[0]
        path.write_bytes(good[:after_head] + chunks * chunk + good[after_head:])
        return path

    return Handmade(write, said)


def twist_of(number: float) -> Handmade:
    """The target has a velocity of three equal numbers."""

    def add(file: ForeignFile) -> None:
        velocity = twist(0, "eye", np.full(3, number))
        file.add("/target/velocity", "geometry_msgs/msg/TwistStamped", velocity, 0)

    return eye(add)


def topics(count: int) -> Handmade:
    """So many topics of sensors."""

    def write(path: Path) -> Path:
        file = ForeignFile()
        for i in range(count):
            content = image(0, "eye", np.full((2, 2), 1000, "<u2"), "16UC1")
            file.add(f"/s{i}/depth", "sensor_msgs/msg/Image", content, 0)
        return file.write(path)

    return Handmade(write, f"has {count} sensors")
