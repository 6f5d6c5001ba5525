"""A flight of the Matrix_ToF_Drones dataset as a recording that Tofscope opens.

Run it from the project's folder: `.venv/bin/python -m benchmarks.matrix_tof_drones FOLDER FILE`,
FOLDER being a flight such as `Matrix_ToF_Drones/Flight DataSet/Approach/A0`, and FILE the recording
that is written. `docs/real_flights.md` says more.
"""

import argparse
import csv
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from mcap.writer import Writer
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from recordings import ros_messages as ros
from robot_assets import SensorModel

OPTICAL = "tof_front_optical_frame"
LAG = 80
"""Milliseconds by which readings arrive later than the poses that belong to them, about.

Found on this dataset before; no parameter of the estimator was chosen with it.
"""

VALID = (5, 9)
"""Target status of readings that ST calls valid."""

# The sensor looks along the drone's x axis; where on the drone it sits is not known.
T_DRONE_SENSOR = np.array([[0, 0, 1, 0], [-1, 0, 0, 0], [0, -1, 0, 0], [0, 0, 0, 1]], dtype=float)


def readings(path: Path) -> Iterator[tuple[int, NDArray[np.float64]]]:
    """Receive time in ms and ranges (8, 8) in metres, NaN invalid, of each image.

    An image is a line with its time and 64 of distance in mm, number of targets, target status.
    """
    rows = np.loadtxt(path, delimiter=",", ndmin=2)
    for image in rows[: len(rows) // 65 * 65].reshape(-1, 65, 3):
        distance, targets, status = image[1:].T.reshape(3, 8, 8)
        valid = (targets > 0) & np.isin(status, VALID) & (distance > 0)
        yield int(image[0, 0]), np.where(valid, distance / 1000.0, np.nan)


def poses(path: Path) -> Iterator[tuple[int, str, NDArray[np.float64]]]:
    """Time in ms, name and T_world_body (4, 4) of Vicon's poses.

    Several arrive under one stamp; the first of them is the one that was waited for.
    """
    seen: set[tuple[str, str]] = set()
    with path.open(encoding="utf-8", newline="") as stream:
        for row in csv.DictReader(stream):
            key = row["name"], row["timeStamp"]
            if key in seen:
                continue
            seen.add(key)
            T = np.eye(4)
            T[:3, :3] = Rotation.from_quat([float(row[f"q{i}"]) for i in "xyzw"]).as_matrix()
            T[:3, 3] = [float(row[f"pos{i}"]) for i in "xyz"]
            yield int(float(row["timeStamp"])), row["name"].lower(), T


def convert(folder: Path, file: Path) -> None:
    """Write the recording of a flight's folder."""
    messages: list[tuple[int, str, object]] = []
    for time, name, T in poses(folder / "state_Vicon.csv"):
        stamp = time * 10**6
        messages.append((stamp, "/tf", ros.transforms(stamp, [("world", name, T)])))
    for time, ranges in readings(folder / "state_ToF.csv"):
        image = ros.depth_image((time - LAG) * 10**6, OPTICAL, ranges)
        messages.append((time * 10**6, "/tof/front/image", image))
    messages.sort(key=lambda message: message[0])
    start = messages[0][0]
    mounted = ros.transforms(start, [("drone", OPTICAL, T_DRONE_SENSOR)])
    info = ros.camera_info(start, OPTICAL, SensorModel())
    messages[:0] = [(start, "/tf_static", mounted), (start, "/tof/front/camera_info", info)]

    with file.open("wb") as stream:
        writer = Writer(stream)
        writer.start(profile="ros2")
        channels: dict[str, int] = {}
        for time, topic, message in messages:
            if topic not in channels:
                kind: str = message.__msgtype__  # type: ignore[attr-defined]
                schema = writer.register_schema(kind, "ros2msg", ros.schema_text(kind))
                channels[topic] = writer.register_channel(topic, "cdr", schema)
            writer.add_message(channels[topic], time, ros.serialise(message), time)
        writer.finish()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="of a flight")
    parser.add_argument("file", type=Path, metavar="FILE", help="recording that is written")
    options = parser.parse_args()
    convert(options.folder, options.file)
