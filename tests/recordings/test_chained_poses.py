"""Poses of many frames at once are those of each."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from recordings.chained_poses import ChainedPoses
from recordings.transforms import TransformTree
from tests.recordings.foreign import at


def random_tree(seed: int, size: int) -> TransformTree:
    """Frames 0, 1, ... below one of those before, or of none, constant, moving or unknown."""
    rng = np.random.default_rng(seed)
    parents, poses = dict[str, str](), dict[str, np.ndarray]()
    for frame in range(1, size):
        if rng.random() < 0.1:
            continue
        parents[str(frame)] = str(rng.integers(max(frame - 3, 0), frame))
        T = np.tile(np.eye(4), (rng.choice([1, 2]), 1, 1))
        T[:, :3, :3] = Rotation.random(len(T), rng=rng).as_matrix()
        T[:, :3, 3] = rng.normal(size=(len(T), 3))
        T[rng.random(len(T)) < 0.1] = np.nan
        poses[str(frame)] = T
    return TransformTree(parents, poses)


@given(st.integers(0, 10**6), st.integers(1, 30), st.integers(0, 29))
def test_all_frames_are_where_each_is(seed, size, above):
    tree, frames = random_tree(seed, size), [str(n) for n in range(size + 1)]
    chained = ChainedPoses(tree, str(above), frames)
    for k in (0, 1):
        expected = [tree.transform(str(above), frame, k) for frame in frames]
        np.testing.assert_array_equal(chained.at(k), expected)


def test_frames_at_the_end_of_a_deep_chain_are_placed():
    depth = 300
    tree = TransformTree(
        {str(n + 1): str(n) for n in range(depth)},
        {str(n + 1): at(x=1.0)[None] for n in range(depth)},
    )
    found = ChainedPoses(tree, "0", ["10", "300"]).at(0)
    np.testing.assert_allclose(found[:, 0, 3], [10.0, 300.0])


def test_no_frames_have_no_poses():
    assert ChainedPoses(TransformTree({}, {}), "base", []).at(0).shape == (0, 4, 4)
