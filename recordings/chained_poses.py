"""Poses of many frames of a tree at once."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from recordings.transforms import TransformTree

_LONGEST = 64
"""Poses of a chain; the products of deeper ones are kept by the tree in parts."""


class ChainedPoses:
    """Poses of frames of a tree in one frame, from one product of matrices for each level.

    The result is that of `TransformTree.transform` bit by bit.

    Args:
        tree: of the frames.
        above: frame of the poses.
        frames: whose poses are wanted; those that do not lie below `above` are asked one by one.
    """

    def __init__(self, tree: "TransformTree", above: str, frames: Sequence[str]) -> None:
        self._tree, self._above, self._frames = tree, above, frames
        chains = [tree.chain_up(frame, above, _LONGEST) for frame in frames]
        self._others = [i for i, chain in enumerate(chains) if chain is None]
        below = [(chain, i) for i, chain in enumerate(chains) if chain is not None]
        below.sort(key=lambda chain_and_place: -len(chain_and_place[0]))
        self._below = [i for _, i in below]
        self._steps = list(dict.fromkeys(step for chain, _ in below for step in chain))
        number = {step: n for n, step in enumerate(self._steps)}
        # Of each level, from the frames upwards: the steps of the chains that are as long.
        self._levels = [
            np.array([number[chain[level]] for chain, _ in below if level < len(chain)])
            for level in range(max((len(chain) for chain, _ in below), default=0))
        ]

    def at(self, k: int) -> NDArray[np.float64]:
        """T_above_frame (F, 4, 4) of all at frame `k` of the recording, NaN where unknown."""
        poses = np.empty((len(self._frames), 4, 4))
        for i in self._others:
            poses[i] = self._tree.transform(self._above, self._frames[i], k)
        products = np.tile(np.eye(4), (len(self._below), 1, 1))
        if self._levels:
            steps = np.stack([self._tree.pose(step, k) for step in self._steps])
            for of_level in self._levels:
                products[: len(of_level)] = steps[of_level] @ products[: len(of_level)]
        poses[self._below] = products
        return poses
