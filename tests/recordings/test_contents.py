from pathlib import Path

import numpy as np
import pytest

from recordings.contents import Topic, Use, natural_key, topics_of
from recordings.decoding import Decoder
from recordings.mcap_file import McapFile
from tests.recordings.foreign import ForeignFile, camera_info, image, twist


def uses(file: ForeignFile, path: Path) -> dict[str, Topic]:
    mcap = McapFile(file.write(path))
    topics = topics_of(mcap, Decoder(mcap))
    mcap.close()
    return {topic.name: topic for topic in topics}


def test_images_are_told_apart_by_size_and_encoding(tmp_path: Path):
    file = ForeignFile()
    kinds = {
        "/a": ("<u2", "16UC1", 8),
        "/b": ("<f4", "32FC1", 8),
        "/c": ("u1", "8UC1", 8),
        "/d": ("<u2", "16UC1", 65),
        "/e": ("u1", "bayer_rggb8", 8),
    }
    for topic, (kind, encoding, size) in kinds.items():
        message = image(0, "eye", np.zeros((size, size), kind), encoding)
        file.add(topic, "sensor_msgs/msg/Image", message, 0)
    found = uses(file, tmp_path / "images.mcap")
    assert [found[t].use for t in kinds] == [
        Use.DEPTH,
        Use.DEPTH,
        Use.STATUS,
        Use.NOTHING,
        Use.NOTHING,
    ]
    assert found["/d"].why_not == "it is 65 x 65, and a sensor has 2 x 2 to 64 x 64 zones"
    assert "bayer_rggb8" in found["/e"].why_not


def test_bytes_are_a_status_only_beside_ranges_of_their_size(tmp_path: Path):
    file = ForeignFile()
    for topic, kind, encoding, size in [
        ("/x/depth", "<u2", "16UC1", 4),
        ("/x/status", "u1", "8UC1", 4),
        ("/x/picture", "u1", "mono8", 32),
        ("/y/status", "u1", "8UC1", 4),
    ]:
        message = image(0, "eye", np.zeros((size, size), kind), encoding)
        file.add(topic, "sensor_msgs/msg/Image", message, 0)
    found = uses(file, tmp_path / "images.mcap")
    assert found["/x/status"].use is Use.STATUS
    for topic in ("/x/picture", "/y/status"):
        assert found[topic].use is Use.NOTHING
        assert found[topic].why_not == "there are no ranges of its size beside it"


def test_intrinsics_that_are_none_are_not_used(tmp_path: Path):
    file = ForeignFile()
    file.add("/i", "sensor_msgs/msg/CameraInfo", camera_info(0, "eye", focal=0.0), 0)
    found = uses(file, tmp_path / "info.mcap")
    assert found["/i"].use is Use.NOTHING
    assert "focal lengths are 0 and 0" in found["/i"].why_not


@pytest.mark.parametrize(
    ("names", "chosen"),
    [
        (["/cmd"], ["/cmd"]),
        (["/cmd", "/target/velocity"], ["/target/velocity"]),
        (["/cmd", "/odom_twist"], []),
        (["/ground_truth/twist", "/cmd"], ["/ground_truth/twist"]),
    ],
)
def test_of_several_velocities_the_one_named_as_truth_is_used(
    tmp_path: Path, names: list[str], chosen: list[str]
):
    file = ForeignFile()
    for name in names:
        file.add(name, "geometry_msgs/msg/TwistStamped", twist(0, "world", np.zeros(3)), 0)
    found = uses(file, tmp_path / "twists.mcap")
    assert [n for n, topic in found.items() if topic.use is Use.VELOCITY] == chosen
    assert all(topic.why_not for n, topic in found.items() if n not in chosen)


def test_other_encodings_are_said_and_not_used(shared_data: Path):
    mcap = McapFile(shared_data / "bags" / "foxglove_json_camera.mcap")
    topics = topics_of(mcap, Decoder(mcap))
    mcap.close()
    assert all(topic.use is Use.NOTHING and topic.why_not for topic in topics)


def test_topics_sort_as_people_count():
    names = ["/ring/10", "/ring/9", "/ring/a", "/base/1"]
    assert sorted(names, key=natural_key) == ["/base/1", "/ring/9", "/ring/10", "/ring/a"]
