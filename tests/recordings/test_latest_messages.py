"""When each sensor was read last, and in which frame."""

from pathlib import Path

import numpy as np
import pytest

from recordings import open_recording
from tests.recordings.foreign import ForeignFile, at, image, transforms
from tests.recordings.test_joints import STEP

LATE = 12_000_000  # nanoseconds


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Three sensors: one in time, one late, one that misses the frames 0 and 3."""
    file = ForeignFile()
    for k in range(4):
        for name, delay, there in (("a", 0, True), ("b", LATE, True), ("c", 0, k in (1, 2))):
            if there:
                stamp = k * STEP + delay
                wall = image(stamp, name, np.full((8, 8), 1500, "<u2"), "16UC1")
                file.add(f"/{name}/image", "sensor_msgs/msg/Image", wall, stamp)
    fixed = transforms(0, [("world", name, at()) for name in "abc"])
    file.add("/tf_static", "tf2_msgs/msg/TFMessage", fixed, 0)
    return file.write(tmp_path / "x.mcap")


def test_a_late_sensor_says_so_and_one_without_a_message_says_when_it_had_one(path: Path):
    with open_recording(path) as recording:
        latest = np.stack([recording.latest_messages(k) for k in range(4)])
        lateness = latest - recording.stamps[:, None]
    np.testing.assert_array_equal(lateness[:, 0], 0.0)
    assert lateness[:, 1] == pytest.approx(LATE * 1e-9)
    assert np.isnan(lateness[0, 2])
    np.testing.assert_array_equal(lateness[1:3, 2], 0.0)
    assert lateness[3, 2] == pytest.approx(-STEP * 1e-9)
