"""Recorded names of joints against a Panda's and others'."""

import random

import pytest

from robot_assets import Robot, load_robot
from tests.robot_assets.urdf import LINK, chain, joint, urdf

ARM = [f"panda_joint{i}" for i in range(1, 8)]
FINGER = "panda_finger_joint1"


@pytest.fixture(scope="module")
def panda() -> Robot:
    return load_robot()


def arm(prefix: str) -> list[str]:
    return [f"{prefix}joint{i}" for i in range(1, 8)]


def fingers(prefix: str) -> list[str]:
    return [f"{prefix}finger_joint{i}" for i in (1, 2)]


def expected(prefix: str) -> dict[str, str]:
    """The match of an arm with fingers; the second finger mimics the first."""
    return dict(zip(arm(prefix), ARM, strict=True)) | {f"{prefix}finger_joint1": FINGER}


PREFIXES = [
    "panda_",
    "fr3_",
    "fer_",
    "left_fr3_",
    "panda_1_",
    "/left/panda_",
    "/panda_",
    "ns/fr3_",
    "/a/b/c/",
    "robot-1:",
    "arm.",
    "",
]
STRANGERS = [
    ["gripper_joint1", "gripper_joint2"],
    ["base_joint1", "base_joint2", "base_joint3"],
    ["left_wheel_joint", "right_wheel_joint", "torso"],
    ["robotiq_85_left_knuckle_joint", "other_finger_joint1"],
]


@pytest.mark.parametrize("prefix", PREFIXES)
def test_a_panda_with_fingers_is_found_by_any_prefix(panda: Robot, prefix: str):
    match = panda.match_joints(arm(prefix) + fingers(prefix))
    assert match.joints == expected(prefix)
    assert match.missing == match.ambiguous == match.rivals == ()
    assert match.prefix == prefix


@pytest.mark.parametrize("strangers", STRANGERS)
@pytest.mark.parametrize("prefix", PREFIXES)
def test_joints_of_other_things_hide_none_of_the_arms(
    panda: Robot, prefix: str, strangers: list[str]
):
    names = arm(prefix) + fingers(prefix) + strangers
    for seed in range(5):
        random.Random(seed).shuffle(names)
        match = panda.match_joints(names)
        assert match.joints == expected(prefix)
        assert match.ambiguous == match.rivals == ()


def test_fingers_of_another_prefix_are_the_robots_where_they_are_the_only_ones(panda: Robot):
    match = panda.match_joints(arm("robot0_") + fingers("gripper0_"))
    assert match.joints["gripper0_finger_joint1"] == FINGER
    match = panda.match_joints(arm("robot0_") + fingers("gripper0_") + fingers("gripper1_"))
    assert match.ambiguous == (FINGER,)
    assert set(match.joints.values()) == set(ARM)


def test_two_complete_arms_are_rivals_and_neither_is_guessed(panda: Robot):
    match = panda.match_joints(arm("left_fr3_") + arm("right_fr3_") + fingers("right_fr3_"))
    assert match.joints == {}
    assert match.prefix is None
    assert match.rivals == ("left_fr3_joint1", "right_fr3_joint1")
    assert set(match.ambiguous) >= set(ARM)


def test_the_robots_own_names_win_over_a_rivals_whose_fingers_stay_its_own(panda: Robot):
    match = panda.match_joints(arm("left/panda_") + fingers("left/panda_") + arm("panda_"))
    assert match.joints == {name: name for name in ARM}
    assert match.prefix == "panda_"
    assert set(match.rivals) == {"left/panda_joint1", "panda_joint1"}
    assert match.missing == (FINGER,)


def test_an_arm_that_lacks_a_joint_is_no_rival(panda: Robot):
    match = panda.match_joints(arm("right_")[:6] + arm("left_"))
    assert match.joints == dict(zip(arm("left_"), ARM, strict=True))
    assert match.rivals == ()


def test_two_arms_that_both_lack_a_joint_are_ambiguous(panda: Robot):
    match = panda.match_joints(arm("left_")[1:] + arm("right_")[1:])
    assert match.joints == {}
    assert match.ambiguous == tuple(ARM[1:])
    assert match.missing == (ARM[0], FINGER)
    assert match.rivals == ()


def test_a_name_said_twice_is_one_joint(panda: Robot):
    assert panda.match_joints(arm("fr3_") * 2).joints == dict(zip(arm("fr3_"), ARM, strict=True))


def test_a_robot_of_sliding_joints_needs_them_all():
    limit = '<limit lower="0" upper="1" effort="1" velocity="1"/>'
    robot = load_robot(
        urdf(
            *(LINK.format(name) for name in "abc"),
            joint("x", "a", "b", "prismatic", limit),
            joint("y", "b", "c", "prismatic", limit),
        )
    )
    match = robot.match_joints(["gantry_x", "gantry_y", "other_x"])
    assert match.joints == {"gantry_x": "x", "gantry_y": "y"}
    assert robot.match_joints(["gantry_x", "other_x"]).ambiguous == ("x",)


def test_one_joint_is_no_evidence_of_a_second_robot():
    robot = load_robot(chain("panda_joint1"))
    match = robot.match_joints(arm("panda_") + fingers("panda_"))
    assert match.joints == {"panda_joint1": "panda_joint1"}
    assert match.rivals == match.missing == ()
    assert robot.match_joints(["a_joint1", "b_joint1"]).ambiguous == ("panda_joint1",)


def test_links_are_called_with_another_prefix(panda: Robot):
    assert panda.link_names("left/fr3_")["panda_link0"] == "left/fr3_link0"
    assert set(panda.link_names("panda_")) == set(panda.link_names("panda_").values())
    assert load_robot(chain("joint1")).link_names("ns/")["link1"] == "ns/link1"
