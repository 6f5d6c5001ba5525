"""A further type of message with ranges: one reader, and nothing else."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from recordings import open_recording, range_formats
from recordings.range_format import RangeFormat
from recordings.range_formats import range_format
from tests.recordings.foreign import ForeignFile, at, camera_info, header, transforms

PERIOD = 66_666_667


def scan(stamp: int, ranges: list[float]) -> dict[str, Any]:
    """A sensor_msgs/LaserScan whose ranges stand for four zones."""
    return {
        "header": header(stamp, "eye"),
        "angle_min": 0.0,
        "angle_max": 1.0,
        "angle_increment": 0.3,
        "time_increment": 0.0,
        "scan_time": 0.0,
        "range_min": 0.0,
        "range_max": 10.0,
        "ranges": ranges,
        "intensities": [],
    }


SCANS = RangeFormat(
    "sensor_msgs/LaserScan",
    lambda scan: (2, 2) if len(scan.ranges) == 4 else f"it has {len(scan.ranges)} ranges",
    lambda scan: np.array(scan.ranges, dtype=np.float64).reshape(2, 2),
)


def write_scans(path: Path, *readings: list[float]) -> Path:
    return scans(*readings).write(path)


def scans(*readings: list[float]) -> ForeignFile:
    file = ForeignFile()
    for k, ranges in enumerate(readings):
        stamp = 10**9 + k * PERIOD
        file.add("/eye/scan", "sensor_msgs/msg/LaserScan", scan(stamp, ranges), stamp)
        pose = transforms(stamp, [("world", "eye", at())])
        file.add("/tf", "tf2_msgs/msg/TFMessage", pose, stamp)
    return file


@pytest.fixture
def _with_scans(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setitem(range_formats._BY_TYPE, SCANS.type, SCANS)


@pytest.mark.usefixtures("_with_scans")
def test_a_format_is_all_that_a_type_of_ranges_needs(tmp_path: Path):
    path = write_scans(tmp_path / "a.mcap", [1.0, 2.0, 0.0, np.inf], [1.5, 2.5, 3.5, 3.75])
    with open_recording(path) as recording:
        [sensor] = recording.sensors
        assert sensor.grid == (2, 2)
        assert recording.cloud(0).points[:, 2].tolist() == [1.0, 2.0]
        assert np.isnan(recording.cloud(0).ranges[0, 1]).all()
        assert recording.cloud(1, max_range=10.0).points[:, 2].tolist() == [1.5, 2.5, 3.5, 3.75]


@pytest.mark.parametrize("informed", [False, True])
def test_rays_of_a_message_count_where_nothing_else_gives_intrinsics(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, informed: bool
):
    rays = np.array([[[-0.5, -0.5, 1], [0.5, -0.5, 1]], [[-0.5, 0.5, 1], [0.5, 0.5, 1]]])
    knowing = replace(SCANS, directions=lambda _: rays)
    monkeypatch.setitem(range_formats._BY_TYPE, SCANS.type, knowing)
    file = scans([2.0, 2.0, 2.0, 2.0])
    if informed:
        info = camera_info(10**9, "eye", size=2, focal=4.0)
        file.add("/eye/camera_info", "sensor_msgs/msg/CameraInfo", info, 10**9)
    with open_recording(file.write(tmp_path / "a.mcap")) as recording:
        side = 0.25 if informed else 1.0  # half a zone of a focal length of 4, or the rays
        assert np.abs(recording.cloud(0).points[:, :2]) == pytest.approx(np.full((4, 2), side))


@pytest.mark.usefixtures("_with_scans")
def test_a_later_message_of_another_size_is_left_out_and_told(tmp_path: Path):
    path = write_scans(tmp_path / "a.mcap", [1.0, 2.0, 3.0, 3.5], [1.0])
    with open_recording(path) as recording:
        assert len(recording.cloud(0).points) == 4
        assert len(recording.cloud(1).points) == 0
        assert any("it has 1 ranges, and not 2 x 2" in said for said in recording.warnings)


def test_types_are_known_with_and_without_msg():
    assert range_format("sensor_msgs/msg/Image") is range_format("sensor_msgs/Image")
    assert range_format("sensor_msgs/msg/LaserScan") is None
