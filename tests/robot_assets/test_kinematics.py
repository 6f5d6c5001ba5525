"""Forward kinematics, judged by yourdfpy's own."""

import numpy as np
import pytest
import yourdfpy

from robot_assets import RobotError, load_robot
from robot_assets.mesh_files import panda_urdf_path
from tests.robot_assets.urdf import LINK, joint, urdf

_LIMIT = '<limit lower="-2" upper="2" effort="1" velocity="1"/>'
_KINDS = urdf(
    *map(LINK.format, ("a", "b", "c", "d", "e", "f")),
    joint("j1", "a", "b", inside=f'<origin xyz="1 2 3" rpy="0.1 0.2 0.3"/>{_LIMIT}'),
    joint("j2", "b", "c", "prismatic", inside=f'<origin xyz="0 0 1"/>{_LIMIT}'),
    joint("j3", "c", "d", "continuous", inside='<mimic joint="j1" multiplier="2" offset="0.1"/>'),
    joint("j4", "b", "e", "fixed", inside='<origin rpy="0 1.57 0"/>'),
    joint("j5", "e", "f", inside=f'<mimic joint="j4" offset="0.5"/>{_LIMIT}'),
)


@pytest.mark.parametrize("source", [None, _KINDS])
def test_poses_are_those_of_yourdfpy(source: str | None, tmp_path):
    path = panda_urdf_path() if source is None else tmp_path / "a.urdf"
    if source is not None:
        path.write_text(source)
    robot = load_robot(path)
    judge = yourdfpy.URDF.load(str(path), load_meshes=False, build_scene_graph=True)
    rng = np.random.default_rng(0)
    for _ in range(5):
        positions = {name: float(rng.uniform(-1, 1)) for name in robot.joint_names}
        judge.update_cfg(np.array(list(positions.values())))
        for link, pose in robot.link_poses(positions).items():
            np.testing.assert_allclose(pose, judge.get_transform(link, robot.base), atol=1e-12)


def test_joints_that_place_a_link_are_those_that_the_links_behind_them_need():
    robot = load_robot(_KINDS)
    assert robot.joints_placing("d") == {"j1"}  # a slide's travel is short, and j3 follows j1
    assert robot.joints_placing("e") == {"j1"}
    assert robot.joints_placing("a") == frozenset()
    for known in ([], ["j1"], ["j4"], ["j1", "j4"]):
        placed = {link for link in robot.links if robot.joints_placing(link) <= set(known)}
        assert robot.links_placed_by(known) == placed


@pytest.mark.parametrize(
    ("parts", "said"),
    [
        ([joint("j", "a", "gone")], "joint j has the link gone, which is not there"),
        ([joint("j", "a", "c"), joint("k", "b", "c")], "link c is the child of two joints"),
        ([], r"it has 3 links without a parent \(a, b, c\) instead of one"),
        ([joint("j", "b", "c"), joint("k", "c", "b")], "its joints form a loop"),
    ],
)
def test_what_is_no_tree_is_refused(parts: list[str], said: str):
    with pytest.raises(RobotError, match=said):
        load_robot(urdf(*map(LINK.format, "abc"), *parts))
