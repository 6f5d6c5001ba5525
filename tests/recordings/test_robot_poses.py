import numpy as np
import pytest
from numpy.typing import NDArray

from recordings.robot_poses import RobotPoses
from recordings.transforms import TransformTree
from robot_assets import Robot, load_robot
from tests.recordings.foreign import at
from tests.robot_assets.urdf import chain

TURN = np.pi / 6
NOTHING = TransformTree({}, {})


@pytest.fixture
def robot(tmp_path) -> Robot:
    """link0 -a-> link1 -b-> link2, both joints about z, all links in one place."""
    path = tmp_path / "arm.urdf"
    path.write_text(chain("a", "b"))
    return load_robot(path)


def positions(a: list[float], b: list[float] | None = None) -> dict[str, NDArray[np.float64]]:
    return {"a": np.array(a)} | ({} if b is None else {"b": np.array(b)})


def test_joints_place_the_links(robot: Robot):
    poses = RobotPoses(robot, positions([0.0, TURN], [0.0, TURN]), NOTHING, "link0")
    assert set(poses.link_poses(0)) == {"link0", "link1", "link2"}
    for link, turn in [("link0", 0.0), ("link1", TURN), ("link2", 2 * TURN)]:
        np.testing.assert_allclose(poses.link_poses(0)[link], np.eye(4), atol=1e-12)
        np.testing.assert_allclose(poses.link_poses(1)[link], at(turn=turn), atol=1e-12)


def test_links_behind_a_joint_that_is_unknown_are_nowhere(robot: Robot):
    poses = RobotPoses(robot, positions([TURN, np.nan], [np.nan, TURN]), NOTHING, "link0")
    assert poses.joint_positions(0) == {"a": TURN}
    assert set(poses.link_poses(0)) == {"link0", "link1"}
    assert poses.joint_positions(1) == {"b": TURN}
    assert "link2" not in poses.link_poses(1)


def test_without_joints_nothing_is_placed(robot: Robot):
    poses = RobotPoses(robot, {}, NOTHING, "world")
    assert poses.joint_positions(0) == {}
    assert poses.link_poses(0) == {}


def test_the_base_goes_where_the_tree_says_and_is_nowhere_where_it_says_nothing(robot: Robot):
    known = np.stack([at(x=2.0, turn=TURN), np.full((4, 4), np.nan)])
    tree = TransformTree({"link0": "world"}, {"link0": known})
    poses = RobotPoses(robot, positions([TURN, TURN], [0.0, 0.0]), tree, "world")
    np.testing.assert_allclose(poses.link_poses(0)["link1"], at(x=2.0, turn=2 * TURN), atol=1e-12)
    assert poses.link_poses(1) == {}


def test_a_link_that_the_tree_places_is_there_and_not_where_the_joints_say(robot: Robot):
    tree = TransformTree({"link2": "link0"}, {"link2": at(z=0.7)[None]})
    poses = RobotPoses(robot, positions([TURN], [TURN]), tree, "link0")
    np.testing.assert_allclose(poses.link_poses(0)["link2"], at(z=0.7), atol=1e-12)
    np.testing.assert_allclose(poses.link_poses(0)["link1"], at(turn=TURN), atol=1e-12)


def test_a_link_may_be_the_fixed_frame(robot: Robot):
    poses = RobotPoses(robot, positions([TURN], [TURN]), NOTHING, "link2")
    np.testing.assert_allclose(poses.link_poses(0)["link0"], at(turn=-2 * TURN), atol=1e-12)
    np.testing.assert_allclose(poses.link_poses(0)["link2"], np.eye(4), atol=1e-12)


@pytest.mark.parametrize("fixed", ["link0", "link1", "link2", "world"])
@pytest.mark.parametrize("in_tree", [{}, {"link0": "world"}, {"link2": "world"}])
def test_links_are_known_at_the_frames_at_which_they_have_a_pose(robot: Robot, fixed, in_tree):
    nan = np.nan
    joints = positions([TURN, TURN, nan, nan, TURN], [TURN, nan, TURN, nan, TURN])
    sampled = np.stack([at(), at(), at(), at(), np.full((4, 4), nan)])
    tree = TransformTree(in_tree, dict.fromkeys(in_tree, sampled))
    poses = RobotPoses(robot, joints, tree, fixed)
    for link in robot.links:
        expected = [link in poses.link_poses(k) for k in range(5)]
        assert poses.known(link, 5).tolist() == expected
    assert not poses.known("elsewhere", 5).any()
