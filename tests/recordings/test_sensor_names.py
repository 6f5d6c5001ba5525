from itertools import permutations
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from recordings import open_recording
from recordings.sensor_names import names_and_rings, sensor_names
from robot_assets import Sensor
from tests.recordings.foreign import ForeignFile, at, camera_info, image, transforms


@pytest.mark.parametrize(
    ("topic", "name"),
    [
        ("/tof/base/0/image", "base/0"),
        ("/image", "image"),
        ("/skin/s3/depth", "skin/s3"),
        ("no_slash", "no_slash"),
        ("/Ärmel links/Größe 3/image", "Ärmel links/Größe 3"),
        ("", "sensor"),
        ("//", "sensor"),
    ],
)
def test_a_sensor_is_called_after_its_topic(topic: str, name: str):
    assert sensor_names([topic]) == [name]


@pytest.mark.parametrize(
    ("topics", "names"),
    [
        (["/left/image", "/right/image"], ["left", "right"]),
        (["/a/tof/0/image", "/a/tof/1/image"], ["tof/0", "tof/1"]),
        (["/left/tof/0/image", "/right/tof/0/image"], ["left/tof/0", "right/tof/0"]),
        (["/l/x/y/0/image", "/r/x/y/0/image"], ["l/x/y/0", "r/x/y/0"]),
        (["/a/left/f/0/i", "/a/right/f/0/i"], ["left/f/0", "right/f/0"]),
    ],
)
def test_the_shortest_tail_that_tells_all_apart_is_the_name(topics: list[str], names: list[str]):
    assert sensor_names(topics) == names


def test_one_name_that_is_taken_makes_all_of_them_longer():
    topics = ["/left/f/0/image", "/right/f/0/image", "/cell/head/eye/image"]
    assert sensor_names(topics) == ["left/f/0", "right/f/0", "cell/head/eye"]
    assert sensor_names(topics[:1], taken=["f/0"]) == ["left/f/0"]


def test_topics_that_differ_only_in_their_last_part_keep_it():
    assert sensor_names(["/tof/image_0", "/tof/image_1"]) == ["tof/image_0", "tof/image_1"]
    assert sensor_names(["/skin/base/0", "/skin/base/1"]) == ["base/0", "base/1"]


def test_a_topic_may_be_the_end_of_another():
    assert sensor_names(["/tof/0/image", "/left/tof/0/image"]) == ["tof/0", "left/tof/0"]


def test_topics_that_no_tail_tells_apart_are_numbered():
    topics = ["/tof/0/image", "/tof/0/image", "/tof//0/image", "/tof/1/image"]
    expected = ["tof/0/image", "tof/0/image (2)", "tof/0/image (3)", "tof/1/image"]
    assert sensor_names(topics) == expected
    assert sensor_names(["", "/", "/sensor"]) == ["sensor", "sensor (2)", "sensor (3)"]


PARTS = st.sampled_from(["", " ", "0", "1", "tof", "left", "image", "é ü", "sensor", "sensor (2)"])
TOPICS = st.lists(PARTS, max_size=5).map("/".join)


@given(topics=st.lists(TOPICS, max_size=6), taken=st.sets(TOPICS, max_size=3))
def test_names_are_unique_and_never_empty(topics: list[str], taken: set[str]):
    names = sensor_names(topics, taken)
    assert len(names) == len(topics)
    assert len(set(names)) == len(names)
    assert taken.isdisjoint(names)
    assert all(name.strip() for name in names)


def test_names_do_not_depend_on_the_order_of_the_topics():
    topics = ["/left/f/0/image", "/right/f/0/image", "/tof/image"]
    expected = dict(zip(topics, sensor_names(topics), strict=True))
    for order in permutations(topics):
        assert dict(zip(order, sensor_names(order), strict=True)) == expected


def rings(topics: list[str]) -> list[str]:
    return [ring for _, ring in names_and_rings(topics, [None] * len(topics))]


def test_a_ring_is_what_stands_before_the_number():
    assert rings(["/tof/base/0/image", "/tof/base/1/image"]) == ["base", "base"]
    assert rings(["/tof/base/left/image", "/eye/image"]) == ["", ""]


def test_rings_of_two_arms_are_two_rings():
    topics = [f"/{arm}/front/{i}/image" for arm in ("left", "right") for i in range(8)]
    assert rings(topics) == ["left/front"] * 8 + ["right/front"] * 8


def test_rings_of_two_arms_are_two_even_where_their_numbers_differ():
    topics = [f"/left/front/{i}/image" for i in range(8)]
    topics += [f"/right/front/{i}/image" for i in range(8, 16)]
    assert rings(topics) == ["left/front"] * 8 + ["right/front"] * 8


def in_ring(name: str) -> Sensor:
    return Sensor(name, "base", "link", np.eye(4))


def test_a_sensor_is_called_like_the_rigs():
    topics = ["/left/base_0/image", "/left/base_1/image", "/other/image"]
    matches = [in_ring("base/0"), in_ring("base/1"), None]
    expected = [("base/0", "base"), ("base/1", "base"), ("other", "")]
    assert names_and_rings(topics, matches) == expected


def test_where_topics_share_a_sensor_of_the_rig_their_own_names_count():
    topics = ["/left/base/0/image", "/right/base/0/image", "/left/base/1/image"]
    matches = [in_ring("base/0"), in_ring("base/0"), in_ring("base/1")]
    assert names_and_rings(topics, matches) == [
        ("left/base/0", "left/base"),
        ("right/base/0", "right/base"),
        ("base/1", "base"),
    ]


def test_the_rig_in_the_file_names_what_the_chosen_one_does_not_tell_apart():
    topics = ["/tof/cell/left/0/image", "/tof/cell/right/0/image", "/tof/cell/up/image"]
    own = [
        Sensor(name, "cell", "link", np.eye(4)) for name in ("cell/left/0", "cell/right/0", "up")
    ]
    chosen = [in_ring("0"), in_ring("0"), None]
    assert names_and_rings(topics, [None] * 3, own) == [
        ("cell/left/0", "cell"),
        ("cell/right/0", "cell"),
        ("up", "cell"),
    ]
    assert names_and_rings(topics, chosen, own) == names_and_rings(topics, [None] * 3, own)
    assert names_and_rings(topics, [in_ring("0"), None, None], own)[0] == ("0", "base")


def test_where_both_rigs_have_one_name_for_two_topics_the_topics_count():
    topics = ["/tof/left/0/image", "/tof/right/0/image"]
    names = names_and_rings(topics, [in_ring("eye"), None], [in_ring("other"), in_ring("eye")])
    assert names == [("left/0", "left"), ("right/0", "right")]


def two_arms(path: Path) -> Path:
    """A ring of three on each of two arms, with equal ends of their topics."""
    file = ForeignFile()
    names = [(arm, i) for arm in ("left", "right") for i in range(3)]
    for k in range(3):
        stamp = k * 66_000_000
        for arm, i in names:
            frame, topic = f"{arm}_{i}", f"/{arm}/front/{i}"
            wall = image(stamp, frame, np.full((8, 8), 1000, "<u2"), "16UC1")
            file.add(f"{topic}/image", "sensor_msgs/msg/Image", wall, stamp)
            info = camera_info(stamp, frame)
            file.add(f"{topic}/camera_info", "sensor_msgs/msg/CameraInfo", info, stamp)
    fixed = transforms(0, [("world", f"{arm}_{i}", at(x=float(i))) for arm, i in names])
    file.add("/tf_static", "tf2_msgs/msg/TFMessage", fixed, 0)
    return file.write(path)


def test_sensors_of_two_arms_have_names_and_rings_of_their_own(tmp_path: Path):
    with open_recording(two_arms(tmp_path / "arms.mcap")) as recording:
        assert [(sensor.name, sensor.ring, sensor.frame) for sensor in recording.sensors] == [
            (f"{arm}/front/{i}", f"{arm}/front", f"{arm}_{i}")
            for arm in ("left", "right")
            for i in range(3)
        ]


def test_the_rings_of_two_arms_may_have_grids_of_two_sizes(tmp_path: Path):
    file = ForeignFile()
    for k in range(3):
        stamp = k * 66_000_000
        for arm, shape in (("left", (8, 8)), ("right", (4, 5))):
            wall = image(stamp, arm, np.full(shape, 1000, "<u2"), "16UC1")
            file.add(f"/{arm}/front/0/image", "sensor_msgs/msg/Image", wall, stamp)
    fixed = transforms(0, [("world", arm, at(x=1.0)) for arm in ("left", "right")])
    file.add("/tf_static", "tf2_msgs/msg/TFMessage", fixed, 0)
    with open_recording(file.write(tmp_path / "x.mcap")) as recording:
        assert [(s.name, s.ring, s.grid) for s in recording.sensors] == [
            ("left/front/0", "left/front", (8, 8)),
            ("right/front/0", "right/front", (4, 5)),
        ]
        assert np.bincount(recording.cloud(1).sensor).tolist() == [64, 20]


@pytest.mark.parametrize("case", ["f11_two_arms_equal_topic_tails", "f05_two_robots_same_frames"])
def test_shared_cases_of_equal_topic_tails(shared_data: Path, case: str):
    with open_recording(shared_data / "cases" / f"{case}.mcap") as recording:
        names = [sensor.name for sensor in recording.sensors]
        first, second = ("left_arm", "right_arm") if "arms" in case else ("robot1", "robot2")
        assert names == [f"{arm}/tof/{i}" for arm in (first, second) for i in range(2)]
