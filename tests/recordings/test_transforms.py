from itertools import pairwise
from pathlib import Path

import numpy as np

from recordings.contents import topics_of
from recordings.decoding import Decoder
from recordings.mcap_file import McapFile
from recordings.transforms import TransformTree, inverse, read_transforms
from tests.recordings.foreign import ForeignFile, at, transforms


def tree() -> TransformTree:
    moving = np.stack([at(x=0.0), at(x=1.0)])
    return TransformTree(
        {"arm": "base", "hand": "arm", "head": "base", "island": "sea"},
        {
            "arm": moving,
            "hand": at(y=1.0)[None],
            "head": at(z=2.0)[None],
            "island": np.eye(4)[None],
        },
    )


def test_poses_chain_up_and_down_the_tree():
    np.testing.assert_allclose(tree().transform("base", "hand", 1)[:3, 3], [1, 1, 0])
    np.testing.assert_allclose(tree().transform("head", "hand", 1)[:3, 3], [1, 1, -2])
    np.testing.assert_allclose(tree().transform("hand", "hand", 0), np.eye(4))


def test_frames_of_different_trees_have_no_pose():
    assert not tree().connected("hand", "island")
    assert np.isnan(tree().transform("hand", "island", 0)).all()


def test_what_lies_above_both_frames_does_not_matter():
    unknown = TransformTree(
        {"base": "world", "arm": "base"},
        {"base": np.full((2, 4, 4), np.nan), "arm": at(x=1.0)[None]},
    )
    np.testing.assert_allclose(unknown.transform("base", "arm", 0)[:3, 3], [1, 0, 0])
    assert np.isnan(unknown.transform("world", "arm", 0)).all()


def test_only_chains_with_a_sampled_pose_move():
    assert tree().moves("head", "hand")
    assert not tree().moves("arm", "hand")


def test_a_loop_ends_and_is_told():
    loop = TransformTree({"a": "b", "b": "a"}, {"a": at(x=1)[None], "b": at(y=1)[None]})
    assert loop.root_of("a") == "b"
    assert loop.root_of("b") == "b"
    assert loop.cut == ["b"]
    np.testing.assert_allclose(loop.transform("b", "a", 0), at(x=1))


def test_a_deep_chain_has_the_poses_of_its_product():
    depth, rng = 700, np.random.default_rng(0)
    names = [f"f{i}" for i in range(depth + 1)]
    poses = {
        name: np.stack([at(*rng.normal(size=4)) for _ in range(2 if i % 5 else 1)])
        for i, name in enumerate(names[1:])
    }
    poses["f400"] = np.stack([at(z=1.0), np.full((4, 4), np.nan)])
    tree = TransformTree(dict(pairwise(reversed(names))), poses)
    assert tree.root_of("f700") == "f0"
    for a, b in ((0, 700), (100, 650), (255, 257), (300, 600), (512, 513)):
        for k in (0, 1):
            expected = np.eye(4)
            for name in names[a + 1 : b + 1]:
                expected = expected @ poses[name][k if len(poses[name]) > 1 else 0]
            np.testing.assert_allclose(tree.transform(names[a], names[b], k), expected, atol=1e-9)
            np.testing.assert_allclose(tree.over(names[a], names[b], 2)[k], expected, atol=1e-9)
        found = tree.known(names[a], names[b], 2).tolist()
        assert found == [True, not a < 400 <= b]


def test_the_inverse_undoes():
    T = at(1, 2, 3, 0.7)
    np.testing.assert_allclose(inverse(T) @ T, np.eye(4), atol=1e-12)


def test_tf_is_read_at_the_frames_and_a_second_parent_is_said(tmp_path: Path):
    file = ForeignFile()
    for i in range(3):
        tf = transforms(i * 100, [("/world", "drone", at(x=float(i))), ("tree", "nest", at())])
        file.add("/tf", "tf2_msgs/msg/TFMessage", tf, i)
    file.add("/tf", "tf2_msgs/msg/TFMessage", transforms(100, [("map", "drone", at(x=9.0))]), 5)
    fixed = transforms(0, [("drone", "eye", at(z=0.1))])
    file.add("/tf_static", "tf2_msgs/msg/TFMessage", fixed, 0)
    mcap = McapFile(file.write(tmp_path / "tf.mcap"))
    decoder = Decoder(mcap)
    tree, warnings = read_transforms(topics_of(mcap, decoder), decoder, np.array([0, 150, 250]))
    mcap.close()
    np.testing.assert_allclose(tree.transform("world", "eye", 1)[:3, 3], [1.5, 0, 0.1], atol=1e-9)
    assert np.isnan(tree.transform("world", "eye", 2)).all()
    assert tree.root_of("eye") == "world"
    assert warnings == ["Frame drone has two parents, world and map; the second is left out."]


def test_poses_over_all_frames_are_those_of_each_frame_to_the_bit():
    numbers = np.random.default_rng(0).normal(size=(201, 4))
    sampled = np.stack([at(*row) for row in numbers])
    sampled[0] = np.nan
    poses = {
        "arm": sampled[:100],
        "hand": sampled[100:200],
        "head": sampled[200:],
        "neck": sampled[1:2],
    }
    tree = TransformTree({"arm": "base", "hand": "arm", "head": "neck", "neck": "base"}, poses)
    for a, b in [("base", "hand"), ("hand", "head"), ("head", "base"), ("base", "sea")]:
        each = np.stack([tree.transform(a, b, k) for k in range(100)])
        np.testing.assert_array_equal(tree.over(a, b, 100), each)
        assert tree.known(a, b, 100).tolist() == np.isfinite(each).all(axis=(1, 2)).tolist()
