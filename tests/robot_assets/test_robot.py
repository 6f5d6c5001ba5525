"""The Panda's kinematics against its published Denavit-Hartenberg values; names, limits, meshes."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot_assets import Robot, load_robot
from tests.robot_assets.urdf import LINK, chain, joint, urdf

ARM = [f"panda_joint{i}" for i in range(1, 8)]

# Franka Emika's own table (Craig's convention): a (m), d (m), alpha (rad) of joints 1 to 7.
DENAVIT_HARTENBERG = [
    (0.0, 0.333, 0.0),
    (0.0, 0.0, -np.pi / 2),
    (0.0, 0.316, np.pi / 2),
    (0.0825, 0.0, np.pi / 2),
    (-0.0825, 0.384, -np.pi / 2),
    (0.0, 0.0, np.pi / 2),
    (0.088, 0.0, np.pi / 2),
]
FLANGE = 0.107


@pytest.fixture(scope="module")
def panda() -> Robot:
    return load_robot()


def denavit_hartenberg(angles: list[float]) -> list[np.ndarray]:
    """Pose (4, 4) of each link after the base, the flange last."""
    T, poses = np.eye(4), []
    for (a, d, alpha), q in zip(DENAVIT_HARTENBERG, angles, strict=True):
        T = T @ np.array(
            [
                [np.cos(q), -np.sin(q), 0, a],
                [
                    np.sin(q) * np.cos(alpha),
                    np.cos(q) * np.cos(alpha),
                    -np.sin(alpha),
                    -d * np.sin(alpha),
                ],
                [
                    np.sin(q) * np.sin(alpha),
                    np.cos(q) * np.sin(alpha),
                    np.cos(alpha),
                    d * np.cos(alpha),
                ],
                [0, 0, 0, 1],
            ]
        )
        poses.append(T)
    flange = np.eye(4)
    flange[2, 3] = FLANGE
    return [*poses, T @ flange]


def within_limits(panda_limits: dict[str, tuple[float, float]], share: list[float]) -> list[float]:
    return [
        low + s * (high - low) for s, (low, high) in zip(share, panda_limits.values(), strict=False)
    ]


@given(share=st.lists(st.floats(0, 1), min_size=7, max_size=7))
def test_forward_kinematics_of_the_panda(panda, share):
    angles = within_limits(panda.joint_limits, share)
    poses = panda.link_poses(dict(zip(ARM, angles, strict=True)))
    for i, expected in enumerate(denavit_hartenberg(angles), start=1):
        assert poses[f"panda_link{i}"] == pytest.approx(expected, abs=1e-9), f"link {i}"


def test_the_ready_pose():
    ready = [0, -np.pi / 4, 0, -3 * np.pi / 4, 0, np.pi / 2, np.pi / 4]
    flange = load_robot().link_poses(dict(zip(ARM, ready, strict=True)))["panda_link8"]
    assert flange[:3, 3] == pytest.approx([0.3069, 0.0, 0.5903], abs=1e-4)
    assert flange[:3, 2] == pytest.approx([0, 0, -1], abs=1e-9)


def test_the_base_stays_and_fingers_slide(panda):
    poses = panda.link_poses({"panda_finger_joint1": 0.03})
    shut = panda.link_poses({"panda_finger_joint1": 0.0})
    assert panda.base == "panda_link0"
    assert poses["panda_link0"] == pytest.approx(np.eye(4))
    for finger in ("panda_leftfinger", "panda_rightfinger"):
        moved = poses[finger][:3, 3] - shut[finger][:3, 3]
        assert np.linalg.norm(moved) == pytest.approx(0.03), "the second finger mimics the first"


def test_a_joint_that_is_not_given_stands_at_its_limit_nearest_to_zero(panda):
    given_nothing = panda.link_poses({})
    explicit = panda.link_poses({"panda_joint4": panda.joint_limits["panda_joint4"][1]})
    assert panda.joint_limits["panda_joint4"][1] < 0
    for link, pose in given_nothing.items():
        assert pose == pytest.approx(explicit[link])


def test_poses_are_right_from_several_threads(panda):
    rng = np.random.default_rng(0)
    angles = [dict(zip(ARM, rng.uniform(-1, -0.1, 7), strict=True)) for _ in range(200)]
    alone = [panda.link_poses(a)["panda_hand"] for a in angles]
    with ThreadPoolExecutor(4) as threads:
        together = list(threads.map(lambda a: panda.link_poses(a)["panda_hand"], angles))
    assert np.array_equal(alone, together)


@pytest.mark.parametrize(
    "pattern",
    ["panda_joint{}", "fer_joint{}", "fr3_joint{}", "/left/panda_joint{}", "ns/joint{}", "joint{}"],
)
def test_joint_names_of_the_franka_family_match(panda, pattern):
    recorded = [pattern.format(i) for i in range(1, 8)]
    match = panda.match_joints(recorded)
    assert match.joints == dict(zip(recorded, ARM, strict=True))
    assert match.missing == ("panda_finger_joint1",)
    assert match.ambiguous == ()


def test_a_finger_is_no_arm_joint(panda):
    recorded = ["fr3_joint1", "fr3_finger_joint1"]
    match = panda.match_joints(recorded)
    assert match.joints == {
        "fr3_joint1": "panda_joint1",
        "fr3_finger_joint1": "panda_finger_joint1",
    }


def test_two_arms_are_ambiguous_and_not_guessed(panda):
    recorded = [f"{side}_joint{i}" for side in ("left", "right") for i in range(1, 8)]
    match = panda.match_joints(recorded)
    assert match.joints == {}
    assert match.ambiguous == tuple(ARM)
    assert match.missing == ("panda_finger_joint1",)


def test_the_exact_name_wins(panda):
    match = panda.match_joints(["other_joint1", "panda_joint1"])
    assert match.joints == {"panda_joint1": "panda_joint1"}
    assert match.ambiguous == ()


@pytest.mark.parametrize(
    "foreign", ["wheel_left", "joint11", "panda_joint", "myjoint1", "joint1_raw", ""]
)
def test_foreign_names_match_nothing(panda, foreign):
    match = panda.match_joints([foreign])
    assert match.joints == {}
    assert match.missing == panda.joint_names


def test_a_prefix_that_names_no_robot_is_part_of_the_name():
    robot = load_robot(chain("joint_1", "joint_2"))
    assert robot.match_joints(["wheel_1"]).joints == {}
    assert robot.match_joints(["abb_joint_1"]).joints == {"abb_joint_1": "joint_1"}


def test_different_prefixes_are_part_of_the_names():
    robot = load_robot(chain("shoulder_joint", "elbow_joint"))
    match = robot.match_joints(["ur_shoulder_joint", "wrist_joint"])
    assert match.joints == {"ur_shoulder_joint": "shoulder_joint"}
    assert match.missing == ("elbow_joint",)


def test_a_joint_outside_its_limits_is_said(panda):
    low, high = panda.joint_limits["panda_joint4"]
    inside = {"panda_joint1": 0.0, "panda_joint4": high}
    assert panda.outside_limits(inside) == []
    assert panda.outside_limits({"panda_joint4": high + 5e-4}) == []
    for value in (0.1, low - 0.1):
        (sentence,) = panda.outside_limits({**inside, "panda_joint4": value})
        assert sentence == (
            f"panda_joint4 is at {value:.3f}, outside its limits {low:.3f} to {high:.3f}."
        )


def test_the_pandas_limits(panda):
    assert panda.joint_limits["panda_joint1"] == (-2.8973, 2.8973)
    assert panda.joint_limits["panda_joint6"] == (-0.0175, 3.7525)
    assert panda.joint_names == (*ARM, "panda_finger_joint1")


def test_a_continuous_joint_and_one_without_bounds_have_no_limits():
    robot = load_robot(
        urdf(
            *(LINK.format(name) for name in "abc"),
            joint("free", "a", "b", "continuous"),
            joint("open", "b", "c", inside='<limit effort="1" velocity="1"/>'),
        )
    )
    assert robot.joint_limits == {}
    assert robot.outside_limits({"free": 100.0, "open": 100.0}) == []


def test_the_panda_has_its_meshes_in_its_own_colours(panda):
    assert panda.mesh_warnings == []
    assert set(panda.collision_meshes) == set(panda.visual_meshes)
    assert "panda_link0" in panda.visual_meshes
    colours = np.asarray(panda.visual_meshes["panda_link0"].visual.vertex_colors)
    assert len(np.unique(colours, axis=0)) > 1
    for mesh in panda.collision_meshes.values():
        assert mesh.is_watertight
        assert 0.01 < mesh.extents.max() < 1.0
