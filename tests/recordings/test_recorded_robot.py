"""Robots that are found by the names of their joints, and placed by their frames in /tf."""

from pathlib import Path

import numpy as np
import pytest

from recordings import Recording, open_recording
from recordings.recorded_robot import link_frames
from robot_assets import load_rig
from tests.recordings.foreign import ForeignFile, at, image, joint_state, transforms, twist
from tests.recordings.test_joints import ARM, FINGER, FRAMES, PANDA, STEP

POSITIONS = ARM | FINGER
LINK_POSES = PANDA.link_poses(POSITIONS)


def named(prefix: str, shift: float = 0.0) -> dict[str, float]:
    """Recorded positions of an arm with both its fingers, by a prefix in place of "panda_"."""
    both = ARM | FINGER | {"panda_finger_joint2": FINGER["panda_finger_joint1"]}
    return {name.replace("panda_", prefix): value + shift for name, value in both.items()}


def written(
    path: Path,
    joints: dict[str, float],
    tf: list[tuple[str, str, np.ndarray]],
    frames: tuple[str, ...] = ("eye",),
) -> ForeignFile:
    """Sensors that look at a wall, the joints of a robot, and poses that stand still."""
    file = ForeignFile()
    wall = np.full((8, 8), 1000, "<u2")
    for k in range(FRAMES):
        stamp = k * STEP
        for frame in frames:
            depth = image(stamp, frame, wall, "16UC1")
            file.add(f"/{frame}/image", "sensor_msgs/msg/Image", depth, stamp)
        state = joint_state(stamp, joints)
        file.add("/joint_states", "sensor_msgs/msg/JointState", state, stamp)
    if tf:
        file.add("/tf_static", "tf2_msgs/msg/TFMessage", transforms(0, tf), 0)
    file.write(path)
    return file


def opened(tmp_path: Path, *written_as: object, **more: object) -> Recording:
    written(tmp_path / "x.mcap", *written_as)  # type: ignore[arg-type]
    return open_recording(tmp_path / "x.mcap", **more)  # type: ignore[arg-type]


def check_links(recording: Recording, T_fixed_base: np.ndarray) -> None:
    poses = recording.link_poses(1)
    assert set(poses) == set(LINK_POSES)
    for link, T in LINK_POSES.items():
        np.testing.assert_allclose(poses[link], T_fixed_base @ T, atol=1e-9)


@pytest.mark.parametrize(
    ("prefix", "base"),
    [
        ("panda_", "panda_link0"),
        ("fr3_", "fr3_link0"),
        ("left_fr3_", "left_fr3_link0"),
        ("/left/panda_", "left/panda_link0"),
        ("/left/panda_", "panda_link0"),
        ("/left/fr3_", "fr3_link0"),
        ("/panda_", "panda_link0"),
        ("", "link0"),
    ],
)
def test_a_panda_of_any_prefix_stands_where_tf_puts_its_base(
    tmp_path: Path, prefix: str, base: str
):
    T_world_base = at(x=0.5, y=-1.0, turn=0.7)
    tf = [("world", base, T_world_base), (base, "eye", at(x=1.0))]
    with opened(tmp_path, named(prefix), tf) as recording:
        assert recording.warnings == ()
        assert recording.fixed_frame == "world"
        assert recording.joint_positions(1) == pytest.approx(POSITIONS)
        check_links(recording, T_world_base)


def test_fingers_are_where_they_were_recorded(tmp_path: Path):
    wide = named("fr3_") | {"fr3_finger_joint1": 0.035, "fr3_finger_joint2": 0.035}
    with opened(tmp_path, wide, [("fr3_link0", "eye", at(x=1.0))]) as recording:
        poses = recording.link_poses(1)
        gap = poses["panda_leftfinger"][:3, 3] - poses["panda_rightfinger"][:3, 3]
        assert np.linalg.norm(gap) == pytest.approx(0.07)


def test_without_fingers_and_with_joints_of_other_things_it_is_a_panda_too(tmp_path: Path):
    others = {"wheel_joint1": 3.0, "wheel_joint2": 4.0, "lift": 0.3}
    arm = {name: value for name, value in named("fr3_").items() if "finger" not in name}
    joints = others | dict(reversed(arm.items()))
    with opened(tmp_path, joints, [("fr3_link0", "eye", at(x=1.0))]) as recording:
        assert recording.fixed_frame == "fr3_link0"
        assert recording.joint_positions(1) == pytest.approx(ARM)
        (warning,) = recording.warnings
        assert "no position of panda_finger_joint1; it is taken to be at rest" in warning


def test_a_moving_link_under_its_own_prefix_may_be_the_root_of_the_tree(tmp_path: Path):
    with opened(tmp_path, named("fr3_"), [("fr3_link3", "eye", at(x=1.0))]) as recording:
        assert recording.fixed_frame == "fr3_link3"
        check_links(recording, np.linalg.inv(LINK_POSES["panda_link3"]))


def test_the_robots_own_names_of_frames_are_understood_when_asked_for(tmp_path: Path):
    tf = [("world", "fr3_link0", at(x=2.0)), ("fr3_link0", "eye", at(x=1.0))]
    with opened(tmp_path, named("fr3_"), tf, fixed_frame="panda_link0") as recording:
        assert recording.fixed_frame == "fr3_link0"
        check_links(recording, np.eye(4))
        np.testing.assert_allclose(recording.cloud(1).T_fixed_sensor[0], at(x=1.0))


def test_the_rig_places_the_sensors_of_a_panda_of_any_prefix_in_its_base(tmp_path: Path):
    file = written(
        tmp_path / "x.mcap",
        named("left_fr3_"),
        [("world", "left_fr3_link0", at(x=2.0))],
        ("base_0", "elbow_3"),
    )
    for k in range(FRAMES):
        velocity = twist(k * STEP, "left_fr3_link0", np.array([0.1, 0, 0]))
        file.add("/target/velocity", "geometry_msgs/msg/TwistStamped", velocity, k * STEP)
    with open_recording(file.write(tmp_path / "x.mcap")) as recording:
        assert recording.fixed_frame == "left_fr3_link0"
        assert recording.warnings == ()
        rig = {sensor.name: sensor for sensor in load_rig().sensors}
        for s, name in enumerate(["base/0", "elbow/3"]):
            expected = LINK_POSES[rig[name].link] @ rig[name].T_link_sensor
            np.testing.assert_allclose(recording.cloud(1).T_fixed_sensor[s], expected, atol=1e-9)
        truth = recording.truth(1)
        assert truth is not None
        np.testing.assert_allclose(truth, [0.1, 0, 0], atol=1e-9)


def test_links_that_tf_places_are_not_said_to_be_lost(tmp_path: Path):
    joints = {name: value for name, value in named("fr3_").items() if name != "fr3_joint7"}
    tf = [("fr3_link0", "eye", at(x=1.0)), ("fr3_link0", "fr3_link7", at(z=0.9))]
    with opened(tmp_path, joints, tf, robot=PANDA) as recording:
        np.testing.assert_allclose(recording.link_poses(1)["panda_link7"], at(z=0.9))
        (warning,) = recording.warnings
        assert "no position of panda_joint7" in warning
        assert "panda_hand" in warning
        assert "panda_link7" not in warning


def test_where_two_robots_fit_none_is_guessed_and_both_are_named(tmp_path: Path):
    joints = named("left_fr3_") | named("right_fr3_", 0.01)
    tf = [("left_fr3_link0", "eye", at(x=1.0))]
    with opened(tmp_path, joints, tf) as recording:
        assert recording.robot is None
        (warning,) = recording.warnings
        assert "more than one robot like panda" in warning
        assert "left_fr3_joint1 and that of right_fr3_joint1; none is used" in warning


def test_where_a_second_robot_fits_beside_a_pandas_own_names_both_are_named(tmp_path: Path):
    joints = named("left/panda_", 0.01) | {j: v for j, v in named("panda_").items()}
    with opened(tmp_path, joints, [("panda_link0", "eye", at(x=1.0))]) as recording:
        assert recording.joint_positions(1) == pytest.approx(POSITIONS)
        (warning,) = recording.warnings
        assert "left/panda_joint1" in warning
        assert "that of panda_joint1 is used" in warning


def test_joints_that_are_no_robots_need_no_word(tmp_path: Path):
    joints = {"left_wheel_joint1": 0.0, "right_wheel_joint1": 0.0, "arm_joint2": 0.0}
    with opened(tmp_path, joints, [("base_link", "eye", at(x=1.0))]) as recording:
        assert recording.robot is None
        assert recording.warnings == ()


def test_frames_are_the_links_own_where_tf_has_none_by_the_prefix():
    assert link_frames(PANDA, "fr3_", {"world"})["panda_link0"] == "panda_link0"
    assert link_frames(PANDA, None, {"fr3_link0"})["panda_link0"] == "panda_link0"
    assert link_frames(PANDA, "fr3_", {"panda_link0", "fr3_hand"})["panda_link0"] == "fr3_link0"


@pytest.mark.parametrize(
    ("case", "base"), [("r10_fr3_with_fingers", "fr3"), ("r10_panda_with_fingers", "panda")]
)
def test_shared_cases_of_a_panda_with_fingers(shared_data: Path, case: str, base: str):
    with open_recording(shared_data / "cases" / f"{case}.mcap") as recording:
        assert recording.robot is not None
        assert recording.fixed_frame == f"{base}_link0"
        assert recording.joint_positions(5)["panda_finger_joint1"] == pytest.approx(0.04)
        assert set(recording.link_poses(5)) == set(PANDA.links)
        assert recording.warnings == ()
        assert [len(recording.cloud(k).points) for k in range(len(recording))] == [104] * 40


def test_shared_case_of_two_arms(shared_data: Path):
    with open_recording(shared_data / "cases" / "r04_two_arms.mcap") as recording:
        assert recording.robot is None
        assert "left_fr3_joint1 and that of right_fr3_joint1" in recording.warnings[0]
