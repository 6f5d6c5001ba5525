"""ROS 2 messages of our writer: standard types, serialised as CDR."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from recordings.frame import PointTruth
from recordings.message_types import standard_types
from robot_assets import SensorModel

_POINT_FIELDS = (
    ("x", "f4"),
    ("y", "f4"),
    ("z", "f4"),
    ("vx", "f4"),
    ("vy", "f4"),
    ("vz", "f4"),
    ("object", "u1"),
)
_BYTE = 256
_POINT_FIELD_TYPES = {"u1": 2, "u2": 4, "f4": 7}


def schema_text(kind: str) -> bytes:
    """Definition of a type such as "sensor_msgs/msg/Image", with the types that it uses."""
    return standard_types().generate_msgdef(kind, ros_version=2)[0].encode("utf-8")


def serialise(message: Any) -> bytes:  # noqa: ANN401 (a message of any type)
    """Serialise a message as CDR."""
    return bytes(standard_types().serialize_cdr(message, message.__msgtype__))


def header(stamp: int, frame: str) -> Any:  # noqa: ANN401
    """std_msgs/Header; `stamp` in nanoseconds."""
    time = _make("builtin_interfaces/msg/Time", sec=stamp // 10**9, nanosec=stamp % 10**9)
    return _make("std_msgs/msg/Header", stamp=time, frame_id=frame)


def depth_image(stamp: int, frame: str, ranges: NDArray[np.float64]) -> Any:  # noqa: ANN401
    """sensor_msgs/Image of readings (rows, columns) in metres: 16UC1, whole millimetres, 0 invalid.

    The sensor reports whole millimetres; REP 118 names this encoding.
    """
    millimetres = np.nan_to_num(np.round(ranges * 1000.0), nan=0.0).astype("<u2")
    return _image(stamp, frame, "16UC1", millimetres)


def status_image(stamp: int, frame: str, status: NDArray[np.uint8]) -> Any:  # noqa: ANN401
    """sensor_msgs/Image, 8UC1, of ST's target status (rows, columns) of readings."""
    return _image(stamp, frame, "8UC1", status)


def _image(stamp: int, frame: str, encoding: str, values: NDArray[Any]) -> Any:  # noqa: ANN401
    rows, columns = values.shape
    return _make(
        "sensor_msgs/msg/Image",
        header=header(stamp, frame),
        height=rows,
        width=columns,
        encoding=encoding,
        is_bigendian=0,
        step=values.dtype.itemsize * columns,
        data=np.frombuffer(values.tobytes(), dtype=np.uint8),
    )


def camera_info(stamp: int, frame: str, model: SensorModel) -> Any:  # noqa: ANN401
    """sensor_msgs/CameraInfo of a sensor model: a pinhole camera whose pixels are zones."""
    fx, fy = model.focal_length, model.vertical_focal_length
    cx, cy = 0.5 * (model.columns - 1), 0.5 * (model.rows - 1)
    region = _make(
        "sensor_msgs/msg/RegionOfInterest",
        x_offset=0,
        y_offset=0,
        height=0,
        width=0,
        do_rectify=False,
    )
    return _make(
        "sensor_msgs/msg/CameraInfo",
        header=header(stamp, frame),
        height=model.rows,
        width=model.columns,
        distortion_model="plumb_bob",
        d=np.zeros(0),
        k=np.array([fx, 0, cx, 0, fy, cy, 0, 0, 1], dtype=np.float64),
        r=np.eye(3).ravel(),
        p=np.array([fx, 0, cx, 0, 0, fy, cy, 0, 0, 0, 1, 0], dtype=np.float64),
        binning_x=0,
        binning_y=0,
        roi=region,
    )


def transforms(stamp: int, poses: list[tuple[str, str, NDArray[np.float64]]]) -> Any:  # noqa: ANN401
    """tf2_msgs/TFMessage of (parent, child, T_parent_child)."""
    return _make(
        "tf2_msgs/msg/TFMessage",
        transforms=[
            _make(
                "geometry_msgs/msg/TransformStamped",
                header=header(stamp, parent),
                child_frame_id=child,
                transform=_make(
                    "geometry_msgs/msg/Transform",
                    translation=_vector(T[:3, 3]),
                    rotation=_quaternion(T[:3, :3]),
                ),
            )
            for parent, child, T in poses
        ],
    )


def joint_state(stamp: int, frame: str, positions: dict[str, float]) -> Any:  # noqa: ANN401
    """sensor_msgs/JointState with positions only."""
    return _make(
        "sensor_msgs/msg/JointState",
        header=header(stamp, frame),
        name=list(positions),
        position=np.array(list(positions.values()), dtype=np.float64),
        velocity=np.zeros(0),
        effort=np.zeros(0),
    )


def text(data: str) -> Any:  # noqa: ANN401
    """std_msgs/String."""
    return _make("std_msgs/msg/String", data=data)


def twist(  # noqa: ANN201
    stamp: int, frame: str, velocity: NDArray[np.float64], turn_rate: NDArray[np.float64]
):
    """geometry_msgs/TwistStamped of a velocity (3,) m/s and an angular velocity (3,) rad/s."""
    motion = _make("geometry_msgs/msg/Twist", linear=_vector(velocity), angular=_vector(turn_rate))
    return _make("geometry_msgs/msg/TwistStamped", header=header(stamp, frame), twist=motion)


def pose(stamp: int, frame: str, T: NDArray[np.float64]) -> Any:  # noqa: ANN401
    """geometry_msgs/PoseStamped of T (4, 4), which takes points of the object into `frame`."""
    x, y, z = T[:3, 3].tolist()
    position = _make("geometry_msgs/msg/Point", x=x, y=y, z=z)
    placed = _make("geometry_msgs/msg/Pose", position=position, orientation=_quaternion(T[:3, :3]))
    return _make("geometry_msgs/msg/PoseStamped", header=header(stamp, frame), pose=placed)


def points(stamp: int, frame: str, truth: PointTruth, sensors: int) -> Any:  # noqa: ANN401
    """sensor_msgs/PointCloud2 of the truth of every reading; `sensors` is their number."""
    kinds = (*_POINT_FIELDS, ("sensor", "u1" if sensors <= _BYTE else "u2"), ("zone", "u2"))
    rows = np.zeros(len(truth.points), dtype=[(n, f"<{kind}") for n, kind in kinds])
    for i, axis in enumerate("xyz"):
        rows[axis] = truth.points[:, i]
        rows[f"v{axis}"] = truth.velocity[:, i]
    rows["object"], rows["sensor"], rows["zone"] = truth.object, truth.sensor, truth.zone
    fields = [
        _make(
            "sensor_msgs/msg/PointField",
            name=name,
            offset=int(rows.dtype.fields[name][1]),  # type: ignore[index]
            datatype=_POINT_FIELD_TYPES[kind],
            count=1,
        )
        for name, kind in kinds
    ]
    return _make(
        "sensor_msgs/msg/PointCloud2",
        header=header(stamp, frame),
        height=1,
        width=len(rows),
        fields=fields,
        is_bigendian=False,
        point_step=rows.dtype.itemsize,
        row_step=rows.dtype.itemsize * len(rows),
        data=np.frombuffer(rows.tobytes(), dtype=np.uint8),
        is_dense=True,
    )


def _make(kind: str, **fields: Any) -> Any:  # noqa: ANN401
    return standard_types().types[kind](**fields)


def _vector(values: NDArray[np.float64]) -> Any:  # noqa: ANN401
    x, y, z = values.tolist()
    return _make("geometry_msgs/msg/Vector3", x=x, y=y, z=z)


def _quaternion(R: NDArray[np.float64]) -> Any:  # noqa: ANN401
    from scipy.spatial.transform import Rotation

    x, y, z, w = Rotation.from_matrix(R).as_quat().tolist()
    return _make("geometry_msgs/msg/Quaternion", x=x, y=y, z=z, w=w)
