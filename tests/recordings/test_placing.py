"""Sensors and truths that can be placed only in part."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from recordings import RecordingError, open_recording
from robot_assets import RigError, load_rig, load_robot
from tests.recordings.foreign import ForeignFile, at, image, joint_state, pose, transforms, twist
from tests.recordings.test_joints import ARM, STEP

WALL = np.full((8, 8), 800, "<u2")


def sensors(names: list[str], placed: list[str], joints: bool = False) -> ForeignFile:
    file = ForeignFile()
    for k in range(4):
        stamp = k * STEP
        for name in names:
            file.add(
                f"/{name}/image", "sensor_msgs/msg/Image", image(stamp, name, WALL, "16UC1"), 0
            )
        for name in placed:
            tf = transforms(stamp, [("world", name, at(z=1.0))])
            file.add("/tf", "tf2_msgs/msg/TFMessage", tf, stamp)
        if joints:
            state = joint_state(stamp, ARM)
            file.add("/joint_states", "sensor_msgs/msg/JointState", state, stamp)
    return file


def test_sensors_that_nothing_places_are_named(tmp_path: Path):
    path = sensors(["left", "right"], ["left"]).write(tmp_path / "x.mcap")
    with open_recording(path) as recording:
        assert "Nothing places right in world" in recording.warnings[0]
        assert set(recording.cloud(1).sensor.tolist()) == {0}


def test_several_sensors_without_any_pose_are_refused(tmp_path: Path):
    path = sensors(["left", "right"], []).write(tmp_path / "x.mcap")
    with pytest.raises(RecordingError, match="nothing places its 2 sensors relative to each other"):
        open_recording(path)


def test_a_rig_that_fits_in_part_is_said(tmp_path: Path):
    path = sensors(["base_0", "strange"], [], joints=True).write(tmp_path / "x.mcap")
    with open_recording(path, rig=load_rig()) as recording:
        said = " ".join(recording.warnings)
        assert "has no sensor named like /strange/image" in said
        assert "Nothing places strange in panda_link0" in said


def test_sensors_of_a_rig_that_no_topic_belongs_to_are_named(tmp_path: Path):
    rig = load_rig()
    few = replace(rig, sensors=rig.sensors[:3])
    path = sensors(["base_0", "base_2"], [], joints=True).write(tmp_path / "x.mcap")
    with open_recording(path, rig=few) as recording:
        assert f"No topic belongs to base/1 of the rig '{rig.name}'." in recording.warnings
    with open_recording(path, rig=rig) as recording:
        said = next(w for w in recording.warnings if w.startswith("No topic belongs to base/1,"))
        assert said.endswith(f" and 14 more of the rig '{rig.name}'.")
    with open_recording(path) as recording:
        assert not any("No topic belongs" in warning for warning in recording.warnings)


def test_two_topics_for_one_sensor_of_the_rig_are_said(tmp_path: Path):
    names = ["left/base_0", "right/base_0", "base_1"]
    path = sensors(names, [], joints=True).write(tmp_path / "x.mcap")
    with open_recording(path, rig=load_rig()) as recording:
        said = " ".join(recording.warnings)
        assert "one sensor, base/0, for the topics /left/base_0/image, /right/base_0/image" in said
        assert "base/1" not in said
        assert [s.name for s in recording.sensors] == ["base/1", "left/base_0", "right/base_0"]
    tf = sensors(names, names, joints=True).write(tmp_path / "x.mcap")
    with open_recording(tf, rig=load_rig()) as recording:
        assert "one spot" not in " ".join(recording.warnings)


def test_a_rig_for_another_robot_is_refused(tmp_path: Path):
    path = sensors(["base_0"], [], joints=True).write(tmp_path / "x.mcap")
    rig = load_rig()
    other = replace(rig, sensors=(replace(rig.sensors[0], link="no_such_link"),))
    with pytest.raises(RigError, match="no_such_link"):
        open_recording(path, rig=other)


def test_a_rig_of_other_zones_is_refused(tmp_path: Path):
    path = sensors(["base_0"], [], joints=True).write(tmp_path / "x.mcap")
    rig = load_rig()
    coarse = replace(rig, model=replace(rig.model, rows=4, columns=4))
    with pytest.raises(RecordingError, match=r"4 x 4 zones \(sensor_model.rows, columns\)"):
        open_recording(path, rig=coarse)


def test_only_the_robots_base_placed_by_tf_is_enough_to_go_on(tmp_path: Path):
    file = sensors(["eye"], ["eye"])
    robot = {"data": load_robot().text}
    file.add("/robot_description", "std_msgs/msg/String", robot, 0)
    base = transforms(0, [("world", "panda_link0", at(y=2.0))])
    file.add("/tf_static", "tf2_msgs/msg/TFMessage", base, 0)
    with open_recording(file.write(tmp_path / "x.mcap")) as recording:
        assert set(recording.link_poses(1)) == {"panda_link0"}
        assert len(recording.cloud(1).points) == 64


def test_a_frame_that_tf_repeats_but_that_stands_still_may_hold_the_truth(tmp_path: Path):
    file = sensors(["eye"], ["eye"])
    rng = np.random.default_rng(0)
    for k in range(20):
        trembling = at(x=1.0 + 1e-5 * rng.normal(), turn=np.pi / 2)
        tf = transforms(k * STEP // 4, [("world", "robot", trembling)])
        file.add("/tf", "tf2_msgs/msg/TFMessage", tf, k)
        velocity = twist(k * STEP // 4, "robot", np.array([0.2, 0, 0]))
        file.add("/target/velocity", "geometry_msgs/msg/TwistStamped", velocity, k)
    with open_recording(file.write(tmp_path / "x.mcap")) as recording:
        assert recording.warnings == ()
        truth = recording.truth(1)
        assert truth is not None
        np.testing.assert_allclose(truth, [0, 0.2, 0], atol=1e-6)


def test_a_pose_is_the_truth_where_the_twist_cannot_be(tmp_path: Path):
    file = sensors(["eye"], ["eye"])
    for k in range(4):
        stamp = k * STEP
        tf = transforms(stamp, [("world", "cart", at(x=stamp * 1e-9))])
        file.add("/tf", "tf2_msgs/msg/TFMessage", tf, stamp)
        velocity = twist(stamp, "cart", np.array([1.0, 0, 0]))
        file.add("/target/velocity", "geometry_msgs/msg/TwistStamped", velocity, stamp)
        moved = pose(stamp, "world", at(y=stamp * 1e-9))
        file.add("/target/pose", "geometry_msgs/msg/PoseStamped", moved, stamp)
    with open_recording(file.write(tmp_path / "x.mcap")) as recording:
        truth = recording.truth(1)
        assert truth is not None
        np.testing.assert_allclose(truth, [0, 1, 0], atol=1e-6)
        assert "cart, which moves in world" in recording.warnings[0]


def test_an_image_of_another_kind_in_the_middle_costs_that_reading_only(tmp_path: Path):
    file = sensors(["eye"], ["eye"])
    strange = image(4 * STEP, "eye", np.full((16, 16), 777, "<u2"), "16UC1")
    file.add("/eye/image", "sensor_msgs/msg/Image", strange, 9)
    with open_recording(file.write(tmp_path / "x.mcap")) as recording:
        assert len(recording.cloud(3).points) == 64
        assert len(recording.cloud(4).points) == 0
        assert "16 x 16" in str(recording.warnings)


def test_sensors_out_of_step_are_said(tmp_path: Path):
    file = ForeignFile()
    for k in range(10):
        for n, name in enumerate(["left", "middle", "right"]):
            stamp = k * STEP + n * 25_000_000
            file.add(
                f"/{name}/i", "sensor_msgs/msg/Image", image(stamp, name, WALL, "16UC1"), stamp
            )
    fixed = transforms(0, [("world", name, at()) for name in ("left", "middle", "right")])
    file.add("/tf_static", "tf2_msgs/msg/TFMessage", fixed, 0)
    with open_recording(file.write(tmp_path / "x.mcap")) as recording:
        assert "of the 3 sensors on average" in recording.warnings[0]
