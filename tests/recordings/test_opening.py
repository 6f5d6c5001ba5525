from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from recordings import RecordingError, open_recording
from robot_assets import load_rig, load_robot
from tests.recordings.foreign import (
    ForeignFile,
    at,
    camera_info,
    image,
    joint_state,
    pose,
    transforms,
    twist,
)
from tests.recordings.room import write_room

STEP = 66_000_000
MIDDLE = dict(
    zip(load_robot().joint_names, [0.1, -0.7, 0.2, -2.3, 0.3, 1.6, 0.7, 0.02], strict=True)
)


def depth(stamp: int, frame: str, millimetres: int = 1000) -> dict:
    return image(stamp, frame, np.full((8, 8), millimetres, "<u2"), "16UC1")


def one_sensor(more: Callable[[ForeignFile, int], None], frames: int = 4) -> ForeignFile:
    """A sensor that looks at a wall 1 m away, and the messages that `more` adds per frame."""
    file = ForeignFile()
    for k in range(frames):
        stamp = k * STEP
        file.add("/eye/image", "sensor_msgs/msg/Image", depth(stamp, "eye"), stamp)
        file.add("/eye/camera_info", "sensor_msgs/msg/CameraInfo", camera_info(stamp, "eye"), stamp)
        more(file, stamp)
    return file


def tf(file: ForeignFile, stamp: int, parent: str, child: str, T: np.ndarray) -> None:
    file.add("/tf", "tf2_msgs/msg/TFMessage", transforms(stamp, [(parent, child, T)]), stamp)


def test_24_sensors_placed_by_tf_give_the_points_that_were_seen(tmp_path: Path):
    room = write_room(tmp_path / "room.mcap")
    with open_recording(room.path) as recording:
        assert recording.fixed_frame == "world"
        assert len(recording.sensors) == 24
        assert recording.warnings == ()
        assert recording.robot is None
        assert not recording.simulated
        np.testing.assert_allclose(recording.stamps, room.stamps * 1e-9)
        for k, points in enumerate(room.points):
            cloud = recording.cloud(k, max_range=100.0)
            np.testing.assert_allclose(cloud.points, points, atol=1e-9)
            truth = recording.truth(k)
            assert truth is not None
            np.testing.assert_allclose(truth, room.velocity)
        pair = recording.pair_truth(0, 8)
        assert pair is not None
        assert pair.points is None
        np.testing.assert_allclose(pair.velocity, np.tile(room.velocity, (len(pair.velocity), 1)))


def test_the_maximum_range_is_along_the_ray(tmp_path: Path):
    path = one_sensor(lambda file, stamp: None).write(tmp_path / "eye.mcap")
    with open_recording(path) as recording:
        corner = float(np.linalg.norm([3.5 / 9.65685, 3.5 / 9.65685, 1.0]))
        assert len(recording.cloud(0, max_range=corner + 1e-3).points) == 64
        assert len(recording.cloud(0, max_range=corner - 1e-3).points) == 60
        assert len(recording.cloud(0, max_range=0.999).points) == 0


def test_frames_outside_the_known_poses_stay_and_are_empty(tmp_path: Path):
    def late(file: ForeignFile, stamp: int) -> None:
        if stamp >= STEP:
            tf(file, stamp, "world", "eye", at(x=stamp / STEP))

    with open_recording(one_sensor(late).write(tmp_path / "eye.mcap")) as recording:
        assert len(recording) == 4
        assert recording.unplaced.tolist() == [True, False, False, False]
        assert len(recording.cloud(0).points) == 0
        assert np.isnan(recording.cloud(0).T_fixed_sensor).all()
        assert len(recording.cloud(1).points) == 64


def test_in_the_sensors_own_frame_no_pose_is_needed(tmp_path: Path):
    def truth(file: ForeignFile, stamp: int) -> None:
        tf(file, stamp, "world", "eye", at(z=0.5 * stamp / STEP))
        tf(file, stamp, "world", "board", at(z=2.0))

    path = one_sensor(truth).write(tmp_path / "eye.mcap")
    with open_recording(path, fixed_frame="eye", truth_frame="board") as recording:
        np.testing.assert_allclose(recording.cloud(2).points[:, 2], 1.0)
        velocity = recording.truth(1)
        assert velocity is not None
        np.testing.assert_allclose(velocity, [0, 0, -0.5 / 0.066], atol=1e-6)
        pair = recording.pair_truth(0, 3)
        assert pair is not None
        assert pair.points is not None
        np.testing.assert_allclose(pair.points[:, 2], -0.5 / 0.066)


def test_a_pose_named_as_target_is_the_truth(tmp_path: Path):
    def target(file: ForeignFile, stamp: int) -> None:
        moved = pose(stamp, "eye", at(y=stamp * 1e-9))
        file.add("/target/pose", "geometry_msgs/msg/PoseStamped", moved, stamp)

    with open_recording(one_sensor(target).write(tmp_path / "eye.mcap")) as recording:
        velocity = recording.truth(1)
        assert velocity is not None
        np.testing.assert_allclose(velocity, [0, 1, 0], atol=1e-6)


def test_a_twist_in_a_turned_frame_is_turned(tmp_path: Path):
    def target(file: ForeignFile, stamp: int) -> None:
        moved = twist(stamp, "table", np.array([1.0, 0, 0]))
        file.add("/anything", "geometry_msgs/msg/TwistStamped", moved, stamp)
        fixed = transforms(stamp, [("eye", "table", at(turn=np.pi / 2))])
        file.add("/tf_static", "tf2_msgs/msg/TFMessage", fixed, stamp)

    with open_recording(one_sensor(target).write(tmp_path / "eye.mcap"), fixed_frame="eye") as r:
        velocity = r.truth(1)
        assert velocity is not None
        np.testing.assert_allclose(velocity, [0, 1, 0], atol=1e-9)


def test_a_twist_in_a_frame_that_moves_is_no_truth_and_that_is_said(tmp_path: Path):
    def target(file: ForeignFile, stamp: int) -> None:
        moved = twist(stamp, "cart", np.array([1.0, 0, 0]))
        file.add("/target/velocity", "geometry_msgs/msg/TwistStamped", moved, stamp)
        tf(file, stamp, "eye", "cart", at(x=stamp * 1e-9))

    with open_recording(one_sensor(target).write(tmp_path / "eye.mcap"), fixed_frame="eye") as r:
        assert r.truth(1) is None
        assert "cart, which moves in eye" in r.warnings[0]


def panda_without_tf(tmp_path: Path, prefix: str = "panda_", names: str = "base_{}") -> Path:
    file = ForeignFile()
    for k in range(4):
        stamp = k * STEP
        for s in range(8):
            frame = names.format(s)
            topic = f"/{frame}/image"
            file.add(topic, "sensor_msgs/msg/Image", depth(stamp, frame, 500), stamp)
        positions = {j.replace("panda_", prefix): v for j, v in MIDDLE.items()}
        file.add(
            "/joint_states", "sensor_msgs/msg/JointState", joint_state(stamp, positions), stamp
        )
    return file.write(tmp_path / "panda.mcap")


@pytest.mark.parametrize("prefix", ["panda_", "fr3_", "left/panda_"])
def test_without_tf_the_joints_and_the_rig_place_the_sensors(tmp_path: Path, prefix: str):
    robot, rig = load_robot(), load_rig()
    links = robot.link_poses(MIDDLE)
    with open_recording(panda_without_tf(tmp_path, prefix)) as recording:
        assert recording.fixed_frame == "panda_link0"
        assert recording.robot is not None
        assert recording.joint_positions(2) == pytest.approx(MIDDLE)
        for s in range(8):
            sensor = rig.sensors[s]
            np.testing.assert_allclose(
                recording.cloud(2).T_fixed_sensor[s], links[sensor.link] @ sensor.T_link_sensor
            )
        np.testing.assert_allclose(recording.link_poses(2)["panda_hand"], links["panda_hand"])


def test_sensors_that_nothing_places_are_refused_by_name(tmp_path: Path):
    path = panda_without_tf(tmp_path, names="mystery_{}")
    with pytest.raises(RecordingError, match=r"no sensor can be placed in panda_link0.*mystery_0"):
        open_recording(path)


def test_joints_missing_or_beyond_their_limits_are_said(tmp_path: Path):
    def joints(file: ForeignFile, stamp: int) -> None:
        arm = {j: v for j, v in MIDDLE.items() if "finger" not in j} | {"panda_joint4": 0.5}
        file.add("/joint_states", "sensor_msgs/msg/JointState", joint_state(stamp, arm), stamp)
        tf(file, stamp, "panda_link0", "eye", at(x=1.0))

    with open_recording(one_sensor(joints).write(tmp_path / "eye.mcap")) as recording:
        said = " ".join(recording.warnings)
        assert "panda_joint4 is at 0.500, outside its limits -3.072 to -0.070" in said
        assert "no position of panda_finger_joint1" in said


def test_the_robots_own_body_is_not_in_the_cloud(tmp_path: Path):
    robot = load_robot()
    base = robot.link_poses(MIDDLE)["panda_link0"]
    looking_at_base = at(x=-1.0, z=0.07) @ np.array(
        [[0, 0, 1.0, 0], [-1, 0, 0, 0], [0, -1, 0, 0], [0, 0, 0, 1]]
    )

    def joints(file: ForeignFile, stamp: int) -> None:
        state = joint_state(stamp, MIDDLE)
        file.add("/joint_states", "sensor_msgs/msg/JointState", state, stamp)
        tf(file, stamp, "panda_link0", "eye", looking_at_base)

    with open_recording(one_sensor(joints).write(tmp_path / "eye.mcap")) as recording:
        points = recording.cloud(1).points
        assert 20 < len(points) < 60
        assert np.linalg.norm(points[:, :2] - base[:2, 3], axis=1).min() > 0.05
        assert np.isfinite(recording.cloud(1).ranges).all()


def test_frames_that_are_not_there_are_refused_with_those_that_are(tmp_path: Path):
    path = write_room(tmp_path / "room.mcap", frames=2).path
    with pytest.raises(RecordingError, match=r"no frame moon; it has world, skin_0, skin_1.* more"):
        open_recording(path, fixed_frame="moon")


def test_a_truth_frame_that_is_not_there_is_said_and_leaves_no_truth(tmp_path: Path):
    path = write_room(tmp_path / "room.mcap", frames=2).path
    with open_recording(path, truth_frame="sun") as recording:
        assert not recording.has_truth
        assert "truth frame sun has no pose in world" in recording.warnings[0]


def test_a_file_without_sensors_says_what_it_holds(shared_data: Path):
    with pytest.raises(
        RecordingError,
        match=r"no ranges of a sensor, such as .* of 2 x 2 to 64 x 64 zones.*/joint_states",
    ):
        open_recording(shared_data / "panda_joints" / "excitation.mcap")
    with pytest.raises(RecordingError, match=r"nothing to estimate from.*/odom"):
        open_recording(shared_data / "bags" / "nav2_turtlebot.mcap")


@pytest.mark.parametrize(
    ("name", "grids"),
    [
        ("d02_image_4x4_skhbk", [(4, 4)] * 4),
        ("d13_mixed_4x4_and_8x8", [(8, 8), (8, 8), (4, 4), (4, 4)]),
    ],
)
def test_sensors_of_fewer_zones_open_fully(
    shared_data: Path, name: str, grids: list[tuple[int, int]]
):
    with open_recording(shared_data / "cases" / f"{name}.mcap") as recording:
        assert len(recording) == 40
        assert recording.warnings == ()
        assert [sensor.grid for sensor in recording.sensors] == grids
        zones = sum(rows * columns for rows, columns in grids)
        assert all(len(recording.cloud(k).points) == zones for k in range(40))


@pytest.mark.parametrize("name", ["approach_a0", "approach_a1", "approach_a2", "approach_a3"])
def test_real_flights_open_and_their_panel_stands_still_in_the_world(shared_data: Path, name: str):
    path = shared_data / "matrix_tof_flights" / f"{name}.mcap"
    with open_recording(path, truth_frame="surface") as recording:
        assert recording.fixed_frame == "world"
        assert recording.duplicates > 0
        assert (np.diff(recording.stamps) > 0).all()
        speeds = [v for k in range(len(recording)) if (v := recording.truth(k)) is not None]
        assert np.median(np.linalg.norm(speeds, axis=1)) < 0.02
    with open_recording(path, "tof_front_optical_frame", "surface") as recording:
        clouds = [recording.cloud(k) for k in range(len(recording))]
        assert not recording.unplaced.any()
        assert np.mean([len(cloud.points) for cloud in clouds]) < 40
        speeds = [v for k in range(len(recording)) if (v := recording.truth(k)) is not None]
        assert np.max(np.linalg.norm(speeds, axis=1)) > 0.4


def test_a_recording_may_be_read_from_many_threads(tmp_path: Path):
    path = write_room(tmp_path / "room.mcap").path
    with open_recording(path) as one, open_recording(path) as many:
        expected = [one.cloud(k).points for k in range(len(one))]
        order = np.random.default_rng(0).integers(0, len(many), 200).tolist()
        with ThreadPoolExecutor(8) as pool:
            for k, cloud in zip(order, pool.map(many.cloud, order), strict=True):
                np.testing.assert_array_equal(cloud.points, expected[k])
