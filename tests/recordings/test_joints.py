from pathlib import Path

import numpy as np
import pytest

from recordings import Recording, open_recording
from robot_assets import load_robot
from tests.recordings.foreign import (
    ForeignFile,
    at,
    camera_info,
    image,
    joint_state,
    transforms,
)

STEP = 66_000_000
FRAMES = 4
ARM = {f"panda_joint{i + 1}": v for i, v in enumerate([0.1, -0.7, 0.2, -2.3, 0.3, 1.6, 0.7])}
FINGER = {"panda_finger_joint1": 0.02}
PANDA = load_robot()


def opened(tmp_path: Path, messages: list[tuple[str, int, dict[str, float]]]) -> Recording:
    """A sensor in front of a Panda, with joint states of (topic, stamp, positions)."""
    file = ForeignFile()
    for k in range(FRAMES):
        stamp = k * STEP
        wall = np.full((8, 8), 1000, "<u2")
        file.add("/eye/image", "sensor_msgs/msg/Image", image(stamp, "eye", wall, "16UC1"), stamp)
        file.add("/eye/camera_info", "sensor_msgs/msg/CameraInfo", camera_info(stamp, "eye"), stamp)
        tf = transforms(stamp, [("panda_link0", "eye", at(x=1.0))])
        file.add("/tf", "tf2_msgs/msg/TFMessage", tf, stamp)
    for topic, stamp, positions in messages:
        state = joint_state(stamp, positions)
        file.add(topic, "sensor_msgs/msg/JointState", state, max(stamp, 0))
    return open_recording(file.write(tmp_path / "eye.mcap"), robot=PANDA)


def always(topic: str, positions: dict[str, float]) -> list[tuple[str, int, dict[str, float]]]:
    return [(topic, k * STEP, positions) for k in range(FRAMES)]


def test_positions_are_linear_between_messages(tmp_path: Path):
    later = {joint: value + 0.3 for joint, value in ARM.items()}
    states = [("/joint_states", 0, ARM), ("/joint_states", 3 * STEP, later)]
    with opened(tmp_path, states) as recording:
        assert recording.joint_positions(1)["panda_joint2"] == pytest.approx(-0.6)


def test_arm_and_gripper_may_take_turns_on_one_topic(tmp_path: Path):
    states = [("/joint_states", k * STEP // 4, FINGER if k % 2 else ARM) for k in range(4 * FRAMES)]
    with opened(tmp_path, states) as recording:
        assert recording.joint_positions(2) == pytest.approx(ARM | FINGER)
        assert recording.warnings == ()


def test_measured_positions_win_over_desired_ones_and_that_is_said(tmp_path: Path):
    desired = {joint: value + 0.1 for joint, value in ARM.items()}
    states = always("/joint_states_desired", desired) + always("/joint_states", ARM | FINGER)
    with opened(tmp_path, states) as recording:
        assert recording.joint_positions(1) == pytest.approx(ARM | FINGER)
        assert "/joint_states_desired has joints that another topic has too" in str(
            recording.warnings
        )


def test_links_below_an_unknown_joint_have_no_pose_and_that_is_said(tmp_path: Path):
    known = {joint: value for joint, value in ARM.items() if joint != "panda_joint3"} | FINGER
    with opened(tmp_path, always("/joint_states", known)) as recording:
        poses = recording.link_poses(1)
        assert set(poses) == {"panda_link0", "panda_link1", "panda_link2"}
        expected = PANDA.link_poses(ARM)
        np.testing.assert_allclose(poses["panda_link2"], expected["panda_link2"])
        assert "no position of panda_joint3; panda_link3" in str(recording.warnings)
        assert len(recording.cloud(1).points) > 0


def test_a_joint_that_is_never_a_number_is_unknown(tmp_path: Path):
    states = always("/joint_states", ARM | FINGER | {"panda_joint1": np.nan})
    with opened(tmp_path, states) as recording:
        assert set(recording.link_poses(1)) == {"panda_link0"}
        assert "no position of panda_joint1" in str(recording.warnings)


def test_fingers_rest_where_only_the_arm_is_recorded(tmp_path: Path):
    with opened(tmp_path, always("/joint_states", ARM)) as recording:
        assert set(recording.link_poses(1)) == set(PANDA.links)
        assert "panda_finger_joint1; it is taken to be at rest" in str(recording.warnings)


def test_frames_before_the_first_joint_message_show_no_robot_and_lose_no_points(tmp_path: Path):
    states = [("/joint_states", k * STEP, ARM | FINGER) for k in range(2, FRAMES)]
    with opened(tmp_path, states) as recording:
        # The first message holds for one more period before it.
        assert recording.joint_positions(0) == {}
        assert set(recording.link_poses(0)) == {"panda_link0"}
        assert len(recording.cloud(0).points) == 64
        assert set(recording.link_poses(2)) == set(PANDA.links)
        assert "not known at 1 frames" in str(recording.warnings)
