"""The Panda's kinematics against its published Denavit-Hartenberg values; names, limits, meshes."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from robot_assets import Robot, RobotError, load_robot
from tests.robot_assets.urdf import LINK, box_link, chain, joint, urdf

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
    assert panda.missing_meshes == ()
    assert set(panda.collision_meshes) == set(panda.visual_meshes)
    assert "panda_link0" in panda.visual_meshes
    colours = np.asarray(panda.visual_meshes["panda_link0"].visual.vertex_colors)
    assert len(np.unique(colours, axis=0)) > 1
    for mesh in panda.collision_meshes.values():
        assert mesh.is_watertight
        assert 0.01 < mesh.extents.max() < 1.0


def test_simple_shapes_are_placed_and_sized():
    robot = load_robot(urdf(box_link("body", (0.2, 0.4, 0.6), (1, 2, 3))))
    assert robot.collision_meshes["body"].bounds == pytest.approx(
        np.array([(0.9, 1.8, 2.7), (1.1, 2.2, 3.3)])
    )
    assert robot.visual_meshes == {}


def with_mesh(filename: str, scale: str = "1 1 1") -> str:
    geometry = f'<geometry><mesh filename="{filename}" scale="{scale}"/></geometry>'
    return urdf(f'<link name="body"><collision>{geometry}</collision></link>')


@pytest.mark.parametrize(
    "filename",
    [
        "box.stl",
        "./box.stl",
        "package://bot/box.stl",
        "file://{folder}/box.stl",
        "{folder}/box.stl",
    ],
)
def test_a_mesh_beside_the_description_is_found(tmp_path, monkeypatch, filename):
    monkeypatch.chdir("/")
    trimesh.creation.box((1, 1, 1)).export(tmp_path / "box.stl")
    path = tmp_path / "robot.urdf"
    path.write_text(with_mesh(filename.format(folder=tmp_path), "0.1 0.2 0.3"))
    robot = load_robot(path)
    assert robot.missing_meshes == ()
    assert robot.collision_meshes["body"].extents == pytest.approx([0.1, 0.2, 0.3])


def test_a_mirrored_mesh_still_faces_outward(tmp_path):
    trimesh.creation.box((1, 1, 1)).export(tmp_path / "box.stl")
    path = tmp_path / "robot.urdf"
    path.write_text(with_mesh("box.stl", "1 -1 1"))
    assert load_robot(path).collision_meshes["body"].volume == pytest.approx(1.0)


def test_a_mesh_in_a_package_folder_above_is_found(tmp_path):
    (tmp_path / "bot" / "meshes").mkdir(parents=True)
    (tmp_path / "bot" / "urdf").mkdir()
    trimesh.creation.box((1, 1, 1)).export(tmp_path / "bot" / "meshes" / "box.stl")
    path = tmp_path / "bot" / "urdf" / "robot.urdf"
    path.write_text(with_mesh("package://bot/meshes/box.stl"))
    assert load_robot(path).missing_meshes == ()


def test_missing_meshes_are_named_and_the_rest_works(tmp_path):
    path = tmp_path / "robot.urdf"
    path.write_text(with_mesh("package://bot/gone.dae"))
    robot = load_robot(path)
    assert robot.missing_meshes == ("package://bot/gone.dae",)
    assert robot.collision_meshes == {}
    assert robot.link_poses({})["body"] == pytest.approx(np.eye(4))


@pytest.mark.parametrize(
    ("name", "content"),
    [("bad.stl", b"solid nonsense"), ("bad.dae", b"<x/>"), ("bad.obj", b"v 0 0 0\n")],
)
def test_a_broken_mesh_is_one_sentence_that_names_it(tmp_path, name, content):
    (tmp_path / name).write_bytes(content)
    path = tmp_path / "robot.urdf"
    path.write_text(with_mesh(name))
    robot = load_robot(path)
    with pytest.raises(RobotError) as caught:
        _ = robot.collision_meshes
    assert str(caught.value).startswith(f"The mesh {tmp_path / name} ")
    assert "\n" not in str(caught.value)


LOOP = urdf(
    LINK.format("a"), LINK.format("b"), joint("j", "a", "b", "fixed"), joint("k", "b", "a", "fixed")
)


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (b"", "no element found"),
        (b"hello", "syntax error"),
        (b"\xff\xfe\x00", "not a text file"),
        (b'<robot name="r"><link name="a">', "is not a URDF"),
        (b"<sdf/>", "must be a <robot> with a name"),
        (b'<robot><link name="a"/></robot>', "must be a <robot> with a name"),
        (b'<robot name="r"/>', "has no links"),
        (LOOP.encode(), "not a URDF that can be used"),
        (urdf(LINK.format("a"), joint("j", "gone", "a")).encode(), "not a URDF that can be used"),
    ],
)
def test_a_broken_description_is_one_sentence_that_names_it(tmp_path, capfd, content, reason):
    path = tmp_path / "robot.urdf"
    path.write_bytes(content)
    with pytest.raises(RobotError) as caught:
        load_robot(path)
    sentence = str(caught.value)
    assert sentence.startswith(str(path))
    assert reason in sentence
    assert "\n" not in sentence
    assert capfd.readouterr() == ("", ""), "the sentence is all that a person gets to read"


def test_a_file_that_is_not_there(tmp_path):
    path = tmp_path / "gone.urdf"
    with pytest.raises(
        RobotError, match=r"gone.urdf cannot be read as a URDF file: No such file or directory\.$"
    ):
        load_robot(path)


@pytest.mark.parametrize("declaration", ["", "\n ", '<?xml version="1.0" encoding="utf-8"?>'])
def test_a_text_is_a_description(declaration):
    robot = load_robot(declaration + chain("joint1"))
    assert robot.name == "tester"
    assert robot.links == ("link0", "link1")


def test_a_broken_text_is_said_too():
    with pytest.raises(RobotError, match=r"^The robot description is not a URDF"):
        load_robot("<robot")
