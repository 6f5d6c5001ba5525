"""Recordings as others write them: by another writer, without our metadata, attachments, names."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from mcap_ros2.writer import Writer
from numpy.typing import NDArray
from rosbags.typesys import Stores, get_typestore
from scipy.spatial.transform import Rotation

_STORE = get_typestore(Stores.ROS2_HUMBLE)
FOCAL = 4 / np.tan(np.pi / 8)


@dataclass
class ForeignFile:
    """Collects messages and writes them in the order in which they were added."""

    messages: list[tuple[str, str, dict[str, Any], int]] = field(default_factory=list)

    def add(self, topic: str, kind: str, message: dict[str, Any], log_time: int) -> None:
        self.messages.append((topic, kind, message, log_time))

    def write(self, path: Path) -> Path:
        with path.open("wb") as stream:
            writer = Writer(stream, chunk_size=4096)
            schemas: dict[str, Any] = {}
            for topic, kind, message, log_time in self.messages:
                if kind not in schemas:
                    text, _ = _STORE.generate_msgdef(kind, ros_version=2)
                    schemas[kind] = writer.register_msgdef(kind, text)
                writer.write_message(topic, schemas[kind], message, log_time, log_time)
            writer.finish()
        return path


def header(stamp: int, frame: str) -> dict[str, Any]:
    return {"stamp": {"sec": stamp // 10**9, "nanosec": stamp % 10**9}, "frame_id": frame}


def image(stamp: int, frame: str, values: NDArray[Any], encoding: str, **more: Any) -> dict:
    rows, columns = values.shape
    message = {
        "header": header(stamp, frame),
        "height": rows,
        "width": columns,
        "encoding": encoding,
        "is_bigendian": 0,
        "step": columns * values.dtype.itemsize,
        "data": values.tobytes(),
    }
    return message | more


def camera_info(stamp: int, frame: str, size: int = 8, focal: float = FOCAL) -> dict[str, Any]:
    centre = 0.5 * (size - 1)
    return {
        "header": header(stamp, frame),
        "height": size,
        "width": size,
        "distortion_model": "plumb_bob",
        "d": [],
        "k": [focal, 0, centre, 0, focal, centre, 0, 0, 1],
        "r": [1, 0, 0, 0, 1, 0, 0, 0, 1],
        "p": [focal, 0, centre, 0, 0, focal, centre, 0, 0, 0, 1, 0],
    }


def transforms(stamp: int, poses: list[tuple[str, str, NDArray[np.float64]]]) -> dict[str, Any]:
    return {
        "transforms": [
            {
                "header": header(stamp, parent),
                "child_frame_id": child,
                "transform": {
                    "translation": dict(zip("xyz", T[:3, 3].tolist(), strict=True)),
                    "rotation": dict(
                        zip("xyzw", Rotation.from_matrix(T[:3, :3]).as_quat(), strict=True)
                    ),
                },
            }
            for parent, child, T in poses
        ]
    }


def twist(stamp: int, frame: str, velocity: NDArray[np.float64]) -> dict[str, Any]:
    linear = dict(zip("xyz", velocity.tolist(), strict=True))
    zero = {"x": 0.0, "y": 0.0, "z": 0.0}
    return {"header": header(stamp, frame), "twist": {"linear": linear, "angular": zero}}


def pose(stamp: int, frame: str, T: NDArray[np.float64]) -> dict[str, Any]:
    transform = transforms(stamp, [(frame, "", T)])["transforms"][0]["transform"]
    return {
        "header": header(stamp, frame),
        "pose": {"position": transform["translation"], "orientation": transform["rotation"]},
    }


def point_cloud(
    stamp: int,
    frame: str,
    points: NDArray[np.float64],
    velocities: NDArray[np.float64],
    objects: NDArray[Any],
) -> dict[str, Any]:
    """Positions and velocities as 8-byte floats, the objects as 1-byte integers behind them."""
    names = ["x", "y", "z", "vx", "vy", "vz"]
    rows = np.zeros(len(points), dtype=[*((name, "<f8") for name in names), ("object", "u1")])
    for i, name in enumerate(names):
        rows[name] = np.hstack([points, velocities])[:, i]
    rows["object"] = objects
    fields = [{"name": n, "offset": 8 * i, "datatype": 8, "count": 1} for i, n in enumerate(names)]
    return {
        "header": header(stamp, frame),
        "height": 1,
        "width": len(points),
        "fields": [*fields, {"name": "object", "offset": 48, "datatype": 2, "count": 1}],
        "is_bigendian": False,
        "point_step": rows.dtype.itemsize,
        "row_step": rows.nbytes,
        "data": rows.tobytes(),
        "is_dense": True,
    }


def joint_state(stamp: int, positions: dict[str, float]) -> dict[str, Any]:
    return {
        "header": header(stamp, ""),
        "name": list(positions),
        "position": list(positions.values()),
        "velocity": [],
        "effort": [],
    }


def at(x: float = 0.0, y: float = 0.0, z: float = 0.0, turn: float = 0.0) -> NDArray[np.float64]:
    """A pose (4, 4) at a place, turned about z by `turn` rad."""
    T = np.eye(4)
    T[:3, :3] = Rotation.from_euler("z", turn).as_matrix()
    T[:3, 3] = x, y, z
    return T
