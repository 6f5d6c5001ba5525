"""Fields that messages of each type must have to be used."""

from functools import cache
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rosbags.typesys.store import Typestore

_STAMP = ("header.stamp.sec", "header.stamp.nanosec")
_HEADER = (*_STAMP, "header.frame_id")
_NEEDED = {
    "sensor_msgs/Image": (*_HEADER, "height", "width", "encoding", "is_bigendian", "step", "data"),
    "sensor_msgs/CameraInfo": (*_HEADER, "height", "width", "k"),
    "sensor_msgs/JointState": (*_HEADER, "name", "position"),
    "sensor_msgs/PointCloud2": (
        *_HEADER,
        "height",
        "width",
        "fields.name",
        "fields.offset",
        "fields.datatype",
        "is_bigendian",
        "point_step",
        "row_step",
        "data",
    ),
    "tf2_msgs/TFMessage": (
        *(f"transforms.{field}" for field in (*_HEADER, "child_frame_id")),
        *(f"transforms.transform.translation.{axis}" for axis in "xyz"),
        *(f"transforms.transform.rotation.{axis}" for axis in "xyzw"),
    ),
    "std_msgs/String": ("data",),
    "geometry_msgs/TwistStamped": (
        *_HEADER,
        *(f"twist.{part}.{axis}" for part in ("linear", "angular") for axis in "xyz"),
    ),
    "geometry_msgs/PoseStamped": (
        *_HEADER,
        *(f"pose.position.{axis}" for axis in "xyz"),
        *(f"pose.orientation.{axis}" for axis in "xyzw"),
    ),
}


@cache
def standard_types() -> "Typestore":
    """The standard types of ROS 2."""
    from rosbags.typesys import Stores, get_typestore

    return get_typestore(Stores.ROS2_HUMBLE)


def misfit(store: "Typestore", schema_name: str) -> str:
    """Why messages of a schema cannot be used as what its name says; "" where they can.

    A schema may have further fields, in any order but for the header, which must come first: stamps
    are read from its first bytes.

    Args:
        store: holds the schema and the types that it uses.
        schema_name: such as sensor_msgs/msg/Image.
    """
    needed = _NEEDED.get(schema_name.replace("/msg/", "/"), ())
    standard = standard_types()
    for path in needed:
        found, wanted = _leaf(store, schema_name, path), _leaf(standard, schema_name, path)
        if found is None:
            return f"it has no field {path}"
        if found != wanted:
            return f"its field {path} is of another type"
    begins = list(_STAMP) if "header.frame_id" in needed else []
    if begins and _first_leaves(store, schema_name, len(begins)) != begins:
        return "it does not begin with its header"
    return ""


def _leaf(store: "Typestore", kind: str, path: str) -> tuple[Any, ...] | None:
    """Type at the end of a path of fields, with the sequences on the way; None without it."""
    way: list[Any] = []
    name, *rest = path.split(".")
    described = _fields(store, kind).get(name)
    if described is None:
        return None
    node, content = described
    while node.name in ("ARRAY", "SEQUENCE"):
        (inner, size) = content
        way.append((node.name, size))
        node, content = inner
    if node.name == "BASE":
        return None if rest else (*way, content)
    further = _leaf(store, content, ".".join(rest)) if rest else None
    return None if further is None else (*way, *further)


def _first_leaves(store: "Typestore", kind: str, count: int) -> list[str]:
    """Paths of the first basic fields of a type."""
    paths: list[str] = []
    for name, (node, content) in _fields(store, kind).items():
        inner = _first_leaves(store, content, count) if node.name == "NAME" else []
        paths += [f"{name}.{path}" for path in inner] or [name]
        if len(paths) >= count:
            break
    return paths[:count]


def _fields(store: "Typestore", kind: str) -> dict[str, Any]:
    """{field: its description} of a type; empty where the store lacks it."""
    return dict(store.fielddefs[kind][1]) if kind in store.fielddefs else {}
