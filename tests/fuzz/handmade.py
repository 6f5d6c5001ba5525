"""Hostile recordings made by hand, each of what its name says."""

import numpy as np

from recordings.rig_record import RIG_ATTACHMENT
from recordings.stamp_index import STAMP_INDEX
from tests.fuzz.making import (
    MB,
    SIGNALLING_NAN,
    Handmade,
    arm_file,
    attached,
    bomb,
    camera,
    changed,
    described,
    eye,
    joints,
    line,
    nothing,
    one_bad,
    our_file,
    picture,
    recorded,
    schema,
    shaped,
    topics,
    tree,
    twist_of,
)
from tests.fuzz.seeds import ARM
from tests.robot_assets.urdf import LINK, chain, joint, urdf

_MESH = '<mesh filename="{}"/>'
_NOT_USED = "is not used: it does not fit its type: "

HANDMADE: dict[str, Handmade] = {
    # One bad message, of a topic that is needed or not.
    "bad_tf": one_bad("/tf"),
    "bad_joints": one_bad("/joint_states"),
    "bad_velocity": one_bad("/target/velocity"),
    "bad_pose": one_bad("/target/pose", said=""),
    "bad_image": one_bad("/eye/depth"),
    "bad_image_half": one_bad("/eye/depth", bytes(40)),
    "bad_point_truth": one_bad("/truth/points", seed="ours"),
    "bad_own_image": one_bad("/tof/left/image", seed="ours"),
    "bad_first_image": changed(
        lambda: arm_file().with_message(arm_file().index_of("/eye/depth"), data=b"\x00"),
        "Message 0 of /eye/depth is left out: it is too short for a header.",
    ),
    "bad_only_tf_static": changed(
        lambda: our_file().with_message(our_file().index_of("/tf_static"), data=b"\x00"),
        "of /tf_static is left out",
    ),
    # Schemas of other fields.
    "schema_string": schema("std_msgs/msg/String", b"data", b"other", f"{_NOT_USED}it has no"),
    "schema_twist": schema("geometry_msgs/msg/TwistStamped", b"twist", b"x", _NOT_USED),
    "schema_pose": schema("geometry_msgs/msg/PoseStamped", b" pose", b" x", _NOT_USED),
    "schema_joints": schema(
        "sensor_msgs/msg/JointState", b"float64[] position", b"string[] position", "another type"
    ),
    "schema_tf": schema("tf2_msgs/msg/TFMessage", b"child_frame_id", b"x", _NOT_USED),
    "schema_image": schema("sensor_msgs/msg/Image", b"uint8[] data", b"uint8[] x", "to estimate"),
    "schema_header_last": schema(
        "geometry_msgs/msg/PoseStamped",
        b"std_msgs/Header header",
        b"uint8 first\nstd_msgs/Header header",
        "begin with",
    ),
    "schema_of_itself": schema(
        "std_msgs/msg/String", b"string data", b"std_msgs/String data", "does not fit its type"
    ),
    "schema_no_text": schema("std_msgs/msg/String", b"string", b"\xff\xfe", "cannot be read"),
    "schema_large": schema("std_msgs/msg/String", b"string", b"#" * 300_000, "too many"),
    "schema_array_2_40": schema(
        "std_msgs/msg/String", b"string data", b"float64[1099511627776] data", "another type"
    ),
    # Names.
    "topic_digits": changed(lambda: arm_file().with_message(0, topic="/r" + "9" * 900)),
    "topic_long": changed(lambda: arm_file().with_message(0, topic="/" + "a" * 60_000)),
    "topic_slashes": changed(lambda: arm_file().with_message(0, topic="/" * 60_000)),
    "topic_escape": changed(lambda: arm_file().with_message(0, topic="/\x1b]0;x\x07")),
    "frame_digits": tree(lambda: [("world", "object_" + "7" * 5000), ("world", "eye")]),
    "frame_long": tree(lambda: [("w" * 100_000, "eye")]),
    "frame_lines": tree(lambda: [("world", "a\nb\x1b"), ("a\nb\x1b", "eye")], r"a\nb\x1b", x=1e308),
    "frame_empty": tree(lambda: [("", "eye")]),
    # Attachments and records that lie.
    "index_nothing": attached(STAMP_INDEX, b"", "index of stamps does not fit"),
    "index_no_zip": attached(
        STAMP_INDEX, b"PK\x03\x04" + bytes(100), "index of stamps does not fit"
    ),
    "rig_nothing": attached(RIG_ATTACHMENT, b"", "It is not used"),
    "rig_large": attached(RIG_ATTACHMENT, b"#" * 1_000_001, "too many"),
    "rig_deep": attached(RIG_ATTACHMENT, b"a=" + b"[" * 100_000, "It is not used"),
    "rig_digits": attached(RIG_ATTACHMENT, b"a=" + b"9" * 5000, "It is not used"),
    "record_trial_digits": recorded("wrong or missing", trial="9" * 5000),
    "record_speed_nan": recorded(speed="nan"),
    "record_speed_none": recorded("wrong or missing", speed="fast"),
    "record_escape": recorded(scenario="\x1b[2J=1+1"),
    # Chunks.
    "chunk_zstd_2_GB": bomb("zstd", 1, 2000 * MB, "Broken pieces of the file, 1 of them"),
    "chunks_zstd_60_MB": bomb("zstd", 100, 60 * MB, "Broken pieces of the file, 100 of them"),
    "chunk_zstd_100MB": bomb("zstd", 2, 100 * MB, "Broken pieces of the file, 2 of them"),
    "chunk_lz4_100MB": bomb("lz4", 2, 100 * MB),
    # Images.
    "image_rows": picture("of /eye/depth is left out", height=2**32 - 1),
    "image_step": picture("of /eye/depth is left out", step=2**32 - 1),
    "image_step_0": picture("of /eye/depth is left out", step=0),
    "image_no_data": picture("of /eye/depth is left out", data=b""),
    "image_encoding": picture("of /eye/depth is left out", encoding="rgb8" * 1000),
    "image_big_endian": picture(is_bigendian=255),
    "sensors_2000": topics(1100),
    # Stamps.
    "stamps_zero": eye(nothing, stamps=(0, 0, 0, 0)),
    "stamps_ends": eye(nothing, stamps=(-(2**31) * 10**9, 0, 1, (2**31 - 1) * 10**9)),
    "stamps_backwards": eye(nothing, stamps=(400, 300, 200, 100)),
    # Intrinsics.
    "focal_tiny": camera("a field of view of 45 degrees is assumed", fx=5e-324),
    "focal_nan": camera("its focal lengths are", fy=np.nan),
    "focal_signalling": camera("its focal lengths are", fx=SIGNALLING_NAN),
    "focal_huge": camera("its focal lengths are", fx=1e308),
    "centre_huge": camera("its optical axis is at", cx=1e308),
    "centre_inf": camera("its optical axis is at", cy=-np.inf),
    # Trees of frames.
    "tree_line": tree(lambda: line(3000)),
    "tree_star": tree(lambda: [*(("world", f"f{i}") for i in range(3000)), ("world", "eye")]),
    "tree_objects": tree(
        lambda: [*(("world", f"object_{i}") for i in range(3000)), ("world", "eye")]
    ),
    "tree_loop": tree(lambda: [*line(3000), ("f2999", "f0")], "go round in a circle above f2."),
    "tree_self": tree(lambda: [("eye", "eye")], "go round in a circle above eye"),
    "tree_far": tree(lambda: line(3), "No pose of", x=1e308),
    "tree_no_number": tree(lambda: line(3), "No pose of", x=np.nan),
    "tree_signalling": tree(lambda: line(3), "No pose of", x=SIGNALLING_NAN),
    "tree_two_parents": tree(
        lambda: [("a", "eye"), *((f"b{i}", "eye") for i in range(1, 50))], "two parents, a and b1"
    ),
    # Joints and truth.
    "joints_huge": joints({f"panda_joint{i}": 1e308 for i in range(1, 8)}),
    "joints_nan": joints({f"panda_joint{i}": np.nan for i in range(1, 8)}),
    "joints_signalling": joints({f"panda_joint{i}": SIGNALLING_NAN for i in range(1, 8)}),
    "joints_many": joints({f"{'x_' * i}joint1": 0.0 for i in range(1000)}),
    "truth_huge": twist_of(1e308),
    "truth_inf": twist_of(np.inf),
    "truth_signalling": twist_of(SIGNALLING_NAN),
    # Descriptions of robots.
    "urdf_nothing": described("<robot", "is not a URDF"),
    "urdf_chain": described(chain(*(f"joint{i}" for i in range(2000))), "has no position of"),
    "urdf_loop": described(
        urdf(LINK.format("a"), LINK.format("b"), joint("j", "a", "b"), joint("k", "b", "a")),
        "links without a parent",
    ),
    "urdf_two_parents": described(
        urdf(*map(LINK.format, "abc"), joint("j", "a", "c"), joint("k", "b", "c")),
        "child of two joints",
    ),
    "urdf_many_links": described(urdf(LINK.format("a") * 20_001), "more than 20000"),
    "urdf_many_shapes": described(
        urdf('<link name="a">' + "<visual/>" * 100_000 + "</link>"),
        "100000 meshes or shapes of tester are left out",
    ),
    "urdf_long_names": described(
        urdf(LINK.format("a"), LINK.format("b" * 300_000), joint("j", "a", "b" * 300_000)),
        "names of more than 1000 characters",
    ),
    "urdf_deep": described("<robot name='r'>" + "<a>" * 100_000, "is not a URDF"),
    "urdf_laughs": described(
        '<!DOCTYPE r [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;">]>'
        '<robot name="&b;"><link name="a"/></robot>'
    ),
    "urdf_outside": described(
        '<!DOCTYPE r [<!ENTITY a SYSTEM "file:///etc/passwd">]>'
        '<robot name="r"><link name="a">&a;</link></robot>',
        "is not a URDF",
    ),
    "urdf_mimics_itself": described(
        urdf(*map(LINK.format, "ab"), joint("j", "a", "b", inside='<mimic joint="j"/>'))
    ),
    "urdf_limits": described(
        urdf(*map(LINK.format, "ab"), joint("j", "a", "b", inside='<limit lower="1" upper="-1"/>'))
    ),
    "urdf_axis_nan": described(ARM.replace("0 0 1", "nan 0 0"), "puts links farther than"),
    "urdf_axis_zero": described(ARM.replace("0 0 1", "0 0 0"), "puts links farther than"),
    "urdf_origin_huge": described(ARM.replace("0 0 0.5", "0 0 1e300"), "puts links farther than"),
    "shape_box_one": shaped('<box size="1"/>', "its size cannot be 1"),
    "shape_box_inf": shaped('<box size="inf 1 1"/>', "its size cannot be inf"),
    "shape_cylinder_nan": shaped('<cylinder radius="nan" length="1"/>', "cannot be nan 1"),
    "shape_sphere_huge": shaped('<sphere radius="1e308"/>', "cannot be 1e+308"),
    "shape_unknown": shaped('<capsule radius="1" length="1"/>', "is none of box, cylinder"),
    "shapes_many": described(
        urdf(
            '<link name="base">'
            + '<visual><geometry><sphere radius="0.1"/></geometry></visual>' * 1000
            + "</link>"
        ),
        "the robot has more than 400000 triangles",
    ),
    "mesh_passwd": shaped(_MESH.format("file:///etc/passwd"), "it is not found"),
    "mesh_up": shaped(
        _MESH.format("package://example-robot-data/../../../x.stl"), "it is not found"
    ),
    "mesh_long": shaped(_MESH.format("x" * 5000 + ".stl"), "it is not found"),
    "mesh_memory": shaped(_MESH.format("/proc/self/mem"), "it is not found"),
    "mesh_network": shaped(_MESH.format("http://127.0.0.1:9/a.stl"), "neither a file nor"),
    "mesh_zip": shaped(_MESH.format("package://example-robot-data/README.md"), "left out"),
    "mesh_scale": shaped(
        '<mesh scale="nan 1 1" filename="package://example-robot-data/robots/panda_description/'
        'meshes/collision/finger.stl"/>',
        "its scale cannot be nan 1 1",
    ),
}
