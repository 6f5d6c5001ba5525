"""Poses of the robot's links at the frames of a recording."""

from collections.abc import Mapping
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from recordings.chained_poses import ChainedPoses
from recordings.nearby import Column, known_at
from recordings.transforms import Transform, TransformTree, inverse
from robot_assets import Robot

_CACHED_FRAMES, _LEAST_CACHED = 256, 8
_CACHED_LINKS = 2**17  # of all cached frames, each some 250 bytes


class RobotPoses:
    """Poses of a robot's links at the frames of a recording.

    Args:
        robot: the robot.
        positions: {joint: (K,) rad or m, NaN where unknown} of the recorded joints.
        tree: poses of /tf; its poses of base and links are preferred to forward kinematics.
        fixed_frame: of the link poses.
        link_frames: {link: its frame in /tf}; default: the link's name.
    """

    def __init__(
        self,
        robot: Robot,
        positions: Mapping[str, NDArray[np.float64] | Column],
        tree: TransformTree,
        fixed_frame: str,
        link_frames: Mapping[str, str] | None = None,
    ) -> None:
        self.robot = robot
        self._positions = positions
        self._tree = tree
        self._fixed_frame = fixed_frame
        self._frames = link_frames or {link: link for link in robot.links}
        kept = min(max(_CACHED_LINKS // len(robot.links), _LEAST_CACHED), _CACHED_FRAMES)
        self.link_poses = lru_cache(maxsize=kept)(self._link_poses)

    def joint_positions(self, k: int) -> dict[str, float]:
        """{joint: rad or m} of the joints whose position is known at frame `k`."""
        values = {joint: float(position[k]) for joint, position in self._positions.items()}
        return {joint: value for joint, value in values.items() if np.isfinite(value)}

    def known(self, link: str, frames: int) -> NDArray[np.bool_]:
        """(K,) whether `link_poses` has the link; no forward kinematics are computed."""
        if link not in self._frames:
            return np.zeros(frames, dtype=bool)
        base = self._frames[self.robot.base]
        known = np.full(frames, base == self._fixed_frame)
        if base in self._tree.frames:
            known |= self._tree.known(self._fixed_frame, base, frames)
        for other, frame in self._frames.items():
            if frame == self._fixed_frame:
                known |= self._known_by_joints(other, frames)
        known &= self._known_by_joints(link, frames)
        if self._frames[link] in self._tree.frames:
            known |= self._tree.known(self._fixed_frame, self._frames[link], frames)
        return known

    def _known_by_joints(self, link: str, frames: int) -> NDArray[np.bool_]:
        """(K,) whether a link's pose relative to the base is known by the joints."""
        known = np.zeros(frames, dtype=bool)
        for position in self._positions.values():
            known |= known_at(position)
        for joint in self.robot.joints_placing(link):
            known &= known_at(self._positions[joint]) if joint in self._positions else False
        return known

    def _link_poses(self, k: int) -> dict[str, Transform]:
        """{link: T_fixed_link (4, 4)} of all links whose pose is known at frame `k`."""
        in_tree, chained = self._chained
        found = chained.at(k)
        known = np.flatnonzero(np.isfinite(found).all(axis=(1, 2))).tolist()
        by_tree = {in_tree[i]: found[i] for i in known}
        if len(by_tree) == len(self._frames):
            return by_tree
        T_base_links = self._by_joints(k)
        T_fixed_base = self._base_pose(k, T_base_links)
        if not np.isfinite(T_fixed_base).all():
            return by_tree
        return {link: T_fixed_base @ T for link, T in T_base_links.items()} | by_tree

    @cached_property
    def _chained(self) -> tuple[list[str], ChainedPoses]:
        """Links whose frames are in /tf, and their poses."""
        links = [link for link, frame in self._frames.items() if frame in self._tree.frames]
        frames = [self._frames[link] for link in links]
        return links, ChainedPoses(self._tree, self._fixed_frame, frames)

    def _by_joints(self, k: int) -> dict[str, Transform]:
        """{link: T_base_link (4, 4)} of the links whose pose is known by the joints."""
        joints = self.joint_positions(k)
        if not joints:
            return {}
        placed = self.robot.links_placed_by(joints)
        poses = self.robot.link_poses(joints)
        return {link: T for link, T in poses.items() if link in placed}

    def _base_pose(self, k: int, T_base_links: dict[str, Transform]) -> Transform:
        """T_fixed_base (4, 4), NaN where unknown."""
        base = self._frames[self.robot.base]
        if self._fixed_frame == base:
            return np.eye(4)
        for link, T_base_link in T_base_links.items():
            if self._frames[link] == self._fixed_frame:
                # The fixed frame is a link with forward kinematics.
                return inverse(T_base_link)
        return self._tree.transform(self._fixed_frame, base, k)
