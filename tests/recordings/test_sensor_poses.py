import numpy as np

from recordings.robot_poses import RobotPoses
from recordings.sensor_poses import SensorPoses
from recordings.transforms import TransformTree
from robot_assets import Sensor, load_robot
from tests.recordings.foreign import at
from tests.robot_assets.urdf import chain

UNKNOWN = np.full((4, 4), np.nan)
T_LINK_SENSOR = at(x=0.1)


def rig_sensor(link: str) -> Sensor:
    return Sensor(name="left", ring="", link=link, T_link_sensor=T_LINK_SENSOR)


def tree(*poses: np.ndarray) -> TransformTree:
    return TransformTree({"left": "world"}, {"left": np.stack(poses)})


def test_a_frame_of_the_tree_is_followed():
    poses = SensorPoses(["left"], tree(at(z=1.0), at(z=2.0)), "world", [None], None, 2)
    np.testing.assert_allclose(poses.at(0), [at(z=1.0)])
    np.testing.assert_allclose(poses.at(1), [at(z=2.0)])
    assert poses.unplaced.tolist() == [False, False]


def test_the_rig_places_what_the_tree_does_not_and_only_that(tmp_path):
    (tmp_path / "arm.urdf").write_text(chain("a"))
    joints = {"a": np.array([0.0, 0.5, np.nan])}
    T = tree(at(z=1.0), at(z=1.0), at(z=1.0))
    robot = RobotPoses(load_robot(tmp_path / "arm.urdf"), joints, T, "link0")
    by_rig = SensorPoses(["left"], T, "link0", [rig_sensor("link1")], robot, 3)
    np.testing.assert_allclose(by_rig.at(0), [T_LINK_SENSOR], atol=1e-12)
    np.testing.assert_allclose(by_rig.at(1), [at(turn=0.5) @ T_LINK_SENSOR], atol=1e-12)
    assert np.isnan(by_rig.at(2)).all()
    assert by_rig.unplaced.tolist() == [False, False, True]

    by_tree = SensorPoses(["left"], T, "world", [rig_sensor("link1")], robot, 3)
    np.testing.assert_allclose(by_tree.at(1), [at(z=1.0)])


def test_frames_at_which_no_sensor_is_placed():
    T = TransformTree(
        {"left": "world", "right": "world"},
        {
            "left": np.stack([at(), UNKNOWN, UNKNOWN, UNKNOWN]),
            "right": np.stack([UNKNOWN, at(), UNKNOWN, UNKNOWN]),
        },
    )
    poses = SensorPoses(["left", "right"], T, "world", [None, None], None, 4)
    assert poses.unplaced.tolist() == [False, False, True, True]
    assert np.isnan(poses.at(0)).all(axis=(1, 2)).tolist() == [False, True]


def test_a_sensor_that_nothing_places_is_nowhere():
    poses = SensorPoses(["left"], TransformTree({}, {}), "world", [None], None, 1)
    assert np.isnan(poses.at(0)).all()
    assert poses.unplaced.tolist() == [True]
    alone = SensorPoses(["left"], TransformTree({}, {}), "world", [rig_sensor("x")], None, 1)
    assert np.isnan(alone.at(0)).all()
    assert alone.unplaced.tolist() == [True]
