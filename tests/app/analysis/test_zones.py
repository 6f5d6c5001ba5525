"""What a zone is said to be, from a file in which each kind has one."""

from pathlib import Path

import numpy as np
import pytest

from app.analysis.zones import SOURCE, TARGET, Zone, ZoneState, has_zone, zone_states
from recordings import open_recording
from tests.app.fake_recordings import fake_recording
from tests.recordings.foreign import ForeignFile, at, image, transforms
from tests.recordings.test_joints import STEP


@pytest.fixture(scope="module")
def path(tmp_path_factory) -> Path:
    """A sensor of 8 x 8 zones and one of 4 x 4, which misses the second frame; one is unplaced."""
    file, distances = ForeignFile(), np.full((8, 8), 1500, "<u2")
    status = np.full((8, 8), 5, np.uint8)
    distances[0, 1], status[0, 1] = 0, 255
    status[0, 2] = 4
    distances[0, 3] = 3900
    for k in range(2):
        stamp = k * STEP
        small = image(stamp, "small", np.full((4, 4), 1000, "<u2"), "16UC1")
        far = image(stamp, "lost", np.full((8, 8), 1000, "<u2"), "16UC1")
        seen = image(stamp, "eye", distances, "16UC1")
        file.add("/eye/image", "sensor_msgs/msg/Image", seen, stamp)
        codes = image(stamp, "eye", status, "8UC1")
        file.add("/eye/status", "sensor_msgs/msg/Image", codes, stamp)
        file.add("/lost/image", "sensor_msgs/msg/Image", far, stamp)
        if k == 0:
            file.add("/small/image", "sensor_msgs/msg/Image", small, stamp)
    fixed = transforms(0, [("world", name, at()) for name in ("eye", "small")])
    file.add("/tf_static", "tf2_msgs/msg/TFMessage", fixed, 0)
    return file.write(tmp_path_factory.mktemp("zones") / "x.mcap")


def states(path: Path, k: int) -> dict[str, np.ndarray]:
    with open_recording(path) as recording:
        cloud = recording.cloud(k, 3.0)
        found = zone_states(cloud, 3.0, recording.latest_messages(k))
        return dict(zip([sensor.name for sensor in recording.sensors], found, strict=True))


def test_zones_without_a_point_say_why(path: Path):
    found = states(path, 0)
    row = [ZoneState.POINT, ZoneState.NO_TARGET, ZoneState.REFUSED, ZoneState.TOO_FAR]
    assert found["eye"][0, :4].tolist() == row
    assert (found["eye"][1:] == ZoneState.POINT).all()
    assert (found["lost"] == ZoneState.UNPLACED).all()
    assert (found["small"][:4, :4] == ZoneState.POINT).all()
    assert (found["small"][4:] == ZoneState.OUTSIDE).all()


def test_a_sensor_without_a_message_in_the_frame_is_missing(path: Path):
    found = states(path, 1)
    assert (found["small"][:4, :4] == ZoneState.NO_MESSAGE).all()
    assert (found["small"][:, 4:] == ZoneState.OUTSIDE).all()
    assert found["eye"][1, 1] == ZoneState.POINT


@pytest.mark.parametrize(
    ("sensor", "row", "column", "there"),
    [(0, 19, 24, True), (0, 20, 0, False), (0, 0, 25, False), (1, 0, 0, False), (-1, 0, 0, False)],
)
def test_a_browser_can_name_only_zones_that_there_are(sensor, row, column, there):
    for side in (SOURCE, TARGET):
        assert has_zone(fake_recording(), Zone(side, sensor, row, column)) is there
