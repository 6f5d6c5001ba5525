"""Hostile recordings made by hand, each of what its name says."""

import struct
import zlib
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from itertools import pairwise
from pathlib import Path

import lz4.frame
import numpy as np
import zstandard

from recordings.rig_record import RIG_ATTACHMENT
from recordings.stamp_index import STAMP_INDEX
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
from tests.robot_assets.urdf import LINK, chain, joint, urdf

_SECOND = 10**9
_MB = 2**20


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
def _arm() -> Container:
    return read(seeds()["arm"])


@lru_cache(maxsize=1)
def _ours() -> Container:
    return read(seeds()["ours"])


def _put(change: Callable[[], Container], path: Path) -> Path:
    path.write_bytes(written(change()))
    return path


def _one_bad(
    topic: str, data: bytes = b"\x00\x01", seed: str = "arm", said: str | None = None
) -> Handmade:
    """One message of a topic, the second where there is one, is damaged."""

    def change() -> Container:
        container = read(seeds()[seed])
        indices = [i for i, message in enumerate(container.messages) if message.topic == topic]
        return container.with_message(indices[min(1, len(indices) - 1)], data=data)

    return Handmade(partial(_put, change), f"of {topic} is left out" if said is None else said)


def _schema(kind: str, old: bytes, new: bytes, said: str) -> Handmade:
    def change() -> Container:
        found = next(message.schema for message in _arm().messages if message.kind == kind)
        return _arm().with_kind(kind, schema=found.replace(old, new, 1))

    return Handmade(partial(_put, change), said)


def _described(description: str, said: str = "") -> Handmade:
    return Handmade(partial(arm, description=description), said)


def _shaped(geometry: str, said: str) -> Handmade:
    shape = f"<visual><geometry>{geometry}</geometry></visual>"
    shape += shape.replace("visual>", "collision>")
    return _described(ARM.replace("</link>", f"{shape}</link>", 1), said)


def _attached(name: str, data: bytes, said: str = "") -> Handmade:
    def change() -> Container:
        return replace(_ours(), attachments=_ours().attachments | {name: data})

    return Handmade(partial(_put, change), said)


def _recorded(said: str = "", **values: str) -> Handmade:
    def change() -> Container:
        return replace(_ours(), metadata={"tofscope": _ours().metadata["tofscope"] | values})

    return Handmade(partial(_put, change), said)


def _eye(add: Callable[[ForeignFile], None], said: str = "", stamps: tuple[int, ...] = ()):
    """A sensor that sees a wall, and whatever else is added."""

    def write(path: Path) -> Path:
        file = ForeignFile()
        for k, stamp in enumerate(stamps or [k * 66_666_667 for k in range(4)]):
            ranges = np.full((8, 8), 1000, "<u2")
            file.add("/eye/depth", "sensor_msgs/msg/Image", image(stamp, "eye", ranges, "16UC1"), k)
        add(file)
        return file.write(path)

    return Handmade(write, said)


def _nothing(file: ForeignFile) -> None:
    """Add nothing."""


def _picture(said: str = "", **more: object) -> Handmade:
    def add(file: ForeignFile) -> None:
        bad = image(5 * 66_666_667, "eye", np.full((8, 8), 1000, "<u2"), "16UC1") | more
        file.add("/eye/depth", "sensor_msgs/msg/Image", bad, 5)

    return _eye(add, said)


def _camera(said: str, **k: float) -> Handmade:
    def add(file: ForeignFile) -> None:
        info = camera_info(0, "eye")
        for name, value in k.items():
            info["k"][{"fx": 0, "cx": 2, "fy": 4, "cy": 5}[name]] = value
        file.add("/eye/camera_info", "sensor_msgs/msg/CameraInfo", info, 0)

    return _eye(add, said)


def _tree(edges: Callable[[], list[tuple[str, str]]], said: str = "", x: float = 0.0) -> Handmade:
    def add(file: ForeignFile) -> None:
        poses = [(parent, child, at(x=x)) for parent, child in edges()]
        file.add("/tf_static", "tf2_msgs/msg/TFMessage", transforms(0, poses), 0)

    return _eye(add, said)


def _line(length: int) -> list[tuple[str, str]]:
    names = [*(f"f{i}" for i in range(length)), "eye"]
    return list(pairwise(names))


def _joints(positions: dict[str, float], said: str = "") -> Handmade:
    def add(file: ForeignFile) -> None:
        state = joint_state(0, positions)
        file.add("/joint_states", "sensor_msgs/msg/JointState", state, 0)

    return _eye(add, said)


def _bomb(compression: str, chunks: int, size: int, said: str = "") -> Handmade:
    """Chunks of a few bytes that become large, between the head and the rest of a good file."""

    def write(path: Path) -> Path:
        good = seeds()["arm"]
        data = b"\x80" + struct.pack("<Q", size - 9) + bytes(size - 9)
        packed = {"zstd": zstandard.compress, "lz4": lz4.frame.compress}[compression](data)
        record = struct.pack("<QQQI", 0, 0, size, zlib.crc32(data))
        record += struct.pack("<I", len(compression)) + compression.encode()
        record += struct.pack("<Q", len(packed)) + packed
        chunk = b"\x06" + struct.pack("<Q", len(record)) + record
        after_head = 17 + struct.unpack_from("<Q", good, 9)[0]
        path.write_bytes(good[:after_head] + chunks * chunk + good[after_head:])
        return path

    return Handmade(write, said)


def _twist_of(number: float) -> Handmade:
    def add(file: ForeignFile) -> None:
        velocity = twist(0, "eye", np.full(3, number))
        file.add("/target/velocity", "geometry_msgs/msg/TwistStamped", velocity, 0)

    return _eye(add)


def _topics(count: int) -> Handmade:
    def write(path: Path) -> Path:
        file = ForeignFile()
        for i in range(count):
            content = image(0, "eye", np.full((2, 2), 1000, "<u2"), "16UC1")
            file.add(f"/s{i}/depth", "sensor_msgs/msg/Image", content, 0)
        return file.write(path)

    return Handmade(write, f"has {count} sensors")


_MESH = '<mesh filename="{}"/>'
_NOT_USED = "is not used: it does not fit its type: "

HANDMADE: dict[str, Handmade] = {
    # One bad message, of a topic that is needed or not.
    "bad_tf": _one_bad("/tf"),
    "bad_joints": _one_bad("/joint_states"),
    "bad_velocity": _one_bad("/target/velocity"),
    "bad_pose": _one_bad("/target/pose", said=""),
    "bad_image": _one_bad("/eye/depth"),
    "bad_image_half": _one_bad("/eye/depth", bytes(40)),
    "bad_point_truth": _one_bad("/truth/points", seed="ours"),
    "bad_own_image": _one_bad("/tof/left/image", seed="ours"),
    "bad_first_image": Handmade(
        partial(_put, lambda: _arm().with_message(_arm().index_of("/eye/depth"), data=b"\x00")),
        "Message 0 of /eye/depth is left out: it is too short for a header.",
    ),
    "bad_only_tf_static": Handmade(
        partial(_put, lambda: _ours().with_message(_ours().index_of("/tf_static"), data=b"\x00")),
        "of /tf_static is left out",
    ),
    # Schemas of other fields.
    "schema_string": _schema("std_msgs/msg/String", b"data", b"other", f"{_NOT_USED}it has no"),
    "schema_twist": _schema("geometry_msgs/msg/TwistStamped", b"twist", b"x", _NOT_USED),
    "schema_pose": _schema("geometry_msgs/msg/PoseStamped", b" pose", b" x", _NOT_USED),
    "schema_joints": _schema(
        "sensor_msgs/msg/JointState", b"float64[] position", b"string[] position", "another type"
    ),
    "schema_tf": _schema("tf2_msgs/msg/TFMessage", b"child_frame_id", b"x", _NOT_USED),
    "schema_image": _schema("sensor_msgs/msg/Image", b"uint8[] data", b"uint8[] x", "to estimate"),
    "schema_header_last": _schema(
        "geometry_msgs/msg/PoseStamped",
        b"std_msgs/Header header",
        b"uint8 first\nstd_msgs/Header header",
        "begin with",
    ),
    "schema_of_itself": _schema(
        "std_msgs/msg/String", b"string data", b"std_msgs/String data", "does not fit its type"
    ),
    "schema_no_text": _schema("std_msgs/msg/String", b"string", b"\xff\xfe", "cannot be read"),
    "schema_large": _schema("std_msgs/msg/String", b"string", b"#" * 300_000, "too many"),
    "schema_array_2_40": _schema(
        "std_msgs/msg/String", b"string data", b"float64[1099511627776] data", "another type"
    ),
    # Names.
    "topic_digits": Handmade(
        partial(_put, lambda: _arm().with_message(0, topic="/r" + "9" * 900)), ""
    ),
    "topic_long": Handmade(partial(_put, lambda: _arm().with_message(0, topic="/" + "a" * 60_000))),
    "topic_slashes": Handmade(partial(_put, lambda: _arm().with_message(0, topic="/" * 60_000))),
    "topic_escape": Handmade(partial(_put, lambda: _arm().with_message(0, topic="/\x1b]0;x\x07"))),
    "frame_digits": _tree(lambda: [("world", "object_" + "7" * 5000), ("world", "eye")]),
    "frame_long": _tree(lambda: [("w" * 100_000, "eye")]),
    "frame_empty": _tree(lambda: [("", "eye")]),
    # Attachments and records that lie.
    "index_nothing": _attached(STAMP_INDEX, b"", "index of stamps does not fit"),
    "index_no_zip": _attached(STAMP_INDEX, b"PK\x03\x04" + bytes(100), "index of stamps does not fit"),
    "rig_nothing": _attached(RIG_ATTACHMENT, b"", "It is not used"),
    "rig_large": _attached(RIG_ATTACHMENT, b"#" * 1_000_001, "too many"),
    "rig_deep": _attached(RIG_ATTACHMENT, b"a=" + b"[" * 100_000, "It is not used"),
    "rig_digits": _attached(RIG_ATTACHMENT, b"a=" + b"9" * 5000, "It is not used"),
    "record_trial_digits": _recorded("wrong or missing", trial="9" * 5000),
    "record_speed_nan": _recorded(speed="nan"),
    "record_speed_none": _recorded("wrong or missing", speed="fast"),
    "record_escape": _recorded(scenario="\x1b[2J=1+1"),
    # Chunks.
    "chunk_zstd_2_GB": _bomb("zstd", 1, 2000 * _MB, "Broken pieces of the file, 1 of them"),
    "chunk_zstd_100_MB": _bomb("zstd", 2, 100 * _MB),
    "chunk_lz4_100_MB": _bomb("lz4", 2, 100 * _MB),
    # Images.
    "image_rows": _picture("of /eye/depth is left out", height=2**32 - 1),
    "image_step": _picture("of /eye/depth is left out", step=2**32 - 1),
    "image_step_0": _picture("of /eye/depth is left out", step=0),
    "image_no_data": _picture("of /eye/depth is left out", data=b""),
    "image_encoding": _picture("of /eye/depth is left out", encoding="rgb8" * 1000),
    "image_big_endian": _picture(is_bigendian=255),
    "sensors_2000": _topics(1100),
    # Stamps.
    "stamps_zero": _eye(_nothing, stamps=(0, 0, 0, 0)),
    "stamps_ends": _eye(_nothing, stamps=(-(2**31) * _SECOND, 0, 1, (2**31 - 1) * _SECOND)),
    "stamps_backwards": _eye(_nothing, stamps=(400, 300, 200, 100)),
    # Intrinsics.
    "focal_tiny": _camera("a field of view of 45 degrees is assumed", fx=5e-324),
    "focal_nan": _camera("its focal lengths are", fy=np.nan),
    "focal_huge": _camera("its focal lengths are", fx=1e308),
    "centre_huge": _camera("its optical axis is at", cx=1e308),
    "centre_inf": _camera("its optical axis is at", cy=-np.inf),
    # Trees of frames.
    "tree_line": _tree(lambda: _line(3000)),
    "tree_star": _tree(lambda: [*(("world", f"f{i}") for i in range(3000)), ("world", "eye")]),
    "tree_objects": _tree(
        lambda: [*(("world", f"object_{i}") for i in range(3000)), ("world", "eye")]
    ),
    "tree_loop": _tree(lambda: [*_line(3000), ("f2999", "f0")], "go round in a circle above f2."),
    "tree_self": _tree(lambda: [("eye", "eye")], "go round in a circle above eye"),
    "tree_far": _tree(lambda: _line(3), "No pose of", x=1e308),
    "tree_no_number": _tree(lambda: _line(3), "No pose of", x=np.nan),
    "tree_two_parents": _tree(
        lambda: [("a", "eye"), *((f"b{i}", "eye") for i in range(1, 50))], "two parents, a and b1"
    ),
    # Joints and truth.
    "joints_huge": _joints({f"panda_joint{i}": 1e308 for i in range(1, 8)}),
    "joints_nan": _joints({f"panda_joint{i}": np.nan for i in range(1, 8)}),
    "joints_many": _joints({f"{'x_' * i}joint1": 0.0 for i in range(1000)}),
    "truth_huge": _twist_of(1e308),
    "truth_inf": _twist_of(np.inf),
    # Descriptions of robots.
    "urdf_nothing": _described("<robot", "is not a URDF"),
    "urdf_chain": _described(chain(*(f"joint{i}" for i in range(2000))), "has no position of"),
    "urdf_loop": _described(
        urdf(LINK.format("a"), LINK.format("b"), joint("j", "a", "b"), joint("k", "b", "a")),
        "links without a parent",
    ),
    "urdf_two_parents": _described(
        urdf(*map(LINK.format, "abc"), joint("j", "a", "c"), joint("k", "b", "c")),
        "child of two joints",
    ),
    "urdf_many_links": _described(urdf(LINK.format("a") * 20_001), "more than 20000"),
    "urdf_many_shapes": _described(
        urdf('<link name="a">' + "<visual/>" * 100_000 + "</link>"),
        "100000 meshes or shapes of tester are left out",
    ),
    "urdf_long_names": _described(
        urdf(LINK.format("a"), LINK.format("b" * 300_000), joint("j", "a", "b" * 300_000)),
        "names of more than 1000 characters",
    ),
    "urdf_deep": _described("<robot name='r'>" + "<a>" * 100_000, "is not a URDF"),
    "urdf_laughs": _described(
        '<!DOCTYPE r [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;">]>'
        '<robot name="&b;"><link name="a"/></robot>'
    ),
    "urdf_outside": _described(
        '<!DOCTYPE r [<!ENTITY a SYSTEM "file:///etc/passwd">]>'
        '<robot name="r"><link name="a">&a;</link></robot>',
        "is not a URDF",
    ),
    "urdf_mimics_itself": _described(
        urdf(*map(LINK.format, "ab"), joint("j", "a", "b", inside='<mimic joint="j"/>'))
    ),
    "urdf_limits": _described(
        urdf(*map(LINK.format, "ab"), joint("j", "a", "b", inside='<limit lower="1" upper="-1"/>'))
    ),
    "urdf_axis_nan": _described(ARM.replace("0 0 1", "nan 0 0"), "puts links farther than"),
    "urdf_axis_zero": _described(ARM.replace("0 0 1", "0 0 0"), "puts links farther than"),
    "urdf_origin_huge": _described(ARM.replace("0 0 0.5", "0 0 1e300"), "puts links farther than"),
    "shape_box_one": _shaped('<box size="1"/>', "its size cannot be 1"),
    "shape_box_inf": _shaped('<box size="inf 1 1"/>', "its size cannot be inf"),
    "shape_cylinder_nan": _shaped('<cylinder radius="nan" length="1"/>', "cannot be nan 1"),
    "shape_sphere_huge": _shaped('<sphere radius="1e308"/>', "cannot be 1e+308"),
    "shape_unknown": _shaped('<capsule radius="1" length="1"/>', "is none of box, cylinder"),
    "shapes_many": _described(
        urdf(
            '<link name="base">'
            + '<visual><geometry><sphere radius="0.1"/></geometry></visual>' * 1000
            + "</link>"
        ),
        "the robot has more than 400000 triangles",
    ),
    "mesh_passwd": _shaped(_MESH.format("file:///etc/passwd"), "it lies outside its package"),
    "mesh_up": _shaped(_MESH.format("package://example-robot-data/../../../x.stl"), "not there"),
    "mesh_long": _shaped(_MESH.format("x" * 5000 + ".stl"), "it is not there"),
    "mesh_memory": _shaped(_MESH.format("/proc/self/mem"), "it lies outside its package"),
    "mesh_network": _shaped(_MESH.format("http://127.0.0.1:9/a.stl"), "neither a file nor"),
    "mesh_zip": _shaped(_MESH.format("package://example-robot-data/README.md"), "left out"),
    "mesh_scale": _shaped(
        '<mesh scale="nan 1 1" filename="package://example-robot-data/robots/panda_description/'
        'meshes/collision/finger.stl"/>',
        "its scale cannot be nan 1 1",
    ),
}
