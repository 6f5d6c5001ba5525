"""Transform tree of /tf and /tf_static."""

from array import array
from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from recordings.contents import Topic, Use
from recordings.decoding import Decoder, stamp_of
from recordings.errors import RecordingError, few
from recordings.tracks import PoseTrack, Stamps, last_poses, pose_tracks

Transform = NDArray[np.float64]
_STILL = 1e-3  # metres, and rad of small angles
MOST_POSES = 2**22
"""Poses of moving frames times frames of a recording: 500 MB."""
_TOLD = 8  # frames with two parents that are named
_SEGMENT = 256
"""Frames of a chain whose product is kept; the trees of robots are not as deep."""


class TransformTree:
    """Poses of frames relative to each other at the frames of a recording.

    Args:
        parents: {frame: its parent}; loops are cut, see `cut`.
        poses: {frame: T_parent_frame, (K, 4, 4) over the recording's frames or (1, 4, 4) where it
            is constant, NaN where unknown}.

    Attributes:
        frames: all frames of the tree.
        cut: frames whose parent is left out because it lies below them.
    """

    def __init__(self, parents: Mapping[str, str], poses: Mapping[str, Transform]) -> None:
        self._parents = dict(parents)
        self._poses = poses
        self.frames = frozenset(self._parents) | frozenset(self._parents.values())
        self._depth: dict[str, int] = {}
        self._root: dict[str, str] = {}
        self.cut = [frame for start in list(self._parents) for frame in self._enter(start)]
        self._segment = lru_cache(maxsize=4096)(self._segment_of)
        self._common = lru_cache(maxsize=65536)(self._common_of)

    def root_of(self, frame: str) -> str:
        """Root of the tree that contains `frame`."""
        return self._root.get(frame, frame)

    def connected(self, a: str, b: str) -> bool:
        """Whether a chain of poses leads from `a` to `b`."""
        return self.root_of(a) == self.root_of(b)

    def moves(self, a: str, b: str) -> bool:
        """Whether the pose between two connected frames changes over the recording.

        Changes within a millimetre and a milliradian are noise of measured poses.
        """
        changing = [len(poses) for poses in self._way(a, b) if poses.ndim == 3]
        if not changing:
            return False
        poses = self.over(a, b, changing[0])
        known = poses[np.isfinite(poses).all(axis=(1, 2))]
        return len(known) == 0 or bool(np.ptp(known, axis=0).max() > _STILL)

    def transform(self, a: str, b: str, k: int) -> Transform:
        """T_a_b (4, 4) at frame `k`, NaN where it is unknown or the frames are not connected."""
        return self._relative(a, b, k)

    def over(self, a: str, b: str, frames: int) -> Transform:
        """T_a_b (K, 4, 4) at the first `frames` frames, NaN where unknown."""
        poses = self._relative(a, b, None)
        return np.broadcast_to(poses if poses.ndim == 2 else poses[:frames], (frames, 4, 4)).copy()

    def known(self, a: str, b: str, frames: int) -> NDArray[np.bool_]:
        """(K,) whether T_a_b is known at the first `frames` frames."""
        known = np.full(frames, self.connected(a, b))
        for poses in self._way(a, b):
            finite = np.asarray(np.isfinite(poses).all(axis=(-2, -1)))
            known &= finite if finite.ndim == 0 else finite[:frames]
        return known

    def _enter(self, start: str) -> list[str]:
        """Find depth and root of a frame and of those above; returns the frame of a cut, if any."""
        path, on_path, cut, frame = [start], {start}, [], start
        while frame not in self._depth and (parent := self._parents.get(frame)) is not None:
            if parent in on_path:
                del self._parents[frame]
                cut.append(frame)
                break
            path.append(parent)
            on_path.add(parent)
            frame = parent
        for frame in reversed(path):
            parent = self._parents.get(frame)
            self._depth[frame] = 0 if parent is None else self._depth[parent] + 1
            self._root[frame] = frame if parent is None else self._root[parent]
        return cut

    def _relative(self, a: str, b: str, k: int | None) -> Transform:
        """T_a_b (4, 4) at a frame, or (K, 4, 4) at all, (4, 4) where it is constant."""
        if not self.connected(a, b):
            return np.full((4, 4), np.nan)
        common = self._common(a, b)
        return inverse(self._chain(a, common, k)) @ self._chain(b, common, k)

    def _way(self, a: str, b: str) -> list[Transform]:
        """Poses between two frames over all frames of the recording; empty if not connected."""
        if not self.connected(a, b):
            return []
        common = self._common(a, b)
        return [*self._steps(a, common, None), *self._steps(b, common, None)]

    def _common_of(self, a: str, b: str) -> str:
        """Lowest common ancestor of two connected frames."""
        if self._depth.get(a, 0) == 0:
            return a
        while a != b:
            if self._depth[a] >= self._depth[b]:
                a = self._parents[a]
            else:
                b = self._parents[b]
        return a

    def _chain(self, frame: str, ancestor: str, k: int | None) -> Transform:
        """T_ancestor_frame."""
        T: Transform = np.eye(4)
        for step in self._steps(frame, ancestor, k):
            T = step @ T
        return T

    def _steps(self, frame: str, ancestor: str, k: int | None) -> Iterator[Transform]:
        """Poses that lead from a frame up to an ancestor, each (4, 4), or (K, 4, 4) at all."""
        while frame != ancestor:
            depth = self._depth[frame]
            if depth % _SEGMENT == 0 and depth - _SEGMENT >= self._depth[ancestor]:
                segment, frame = self._segment(frame, k)
                yield segment
            else:
                yield self._pose(frame, k)
                frame = self._parents[frame]

    def _segment_of(self, frame: str, k: int | None) -> tuple[Transform, str]:
        """T_top_frame of the frame so many frames further up, and that frame."""
        T: Transform = np.eye(4)
        for _ in range(_SEGMENT):
            T = self._pose(frame, k) @ T
            frame = self._parents[frame]
        return T, frame

    def _pose(self, frame: str, k: int | None) -> Transform:
        poses = self._poses[frame]
        if len(poses) == 1:
            return poses[0]
        return poses if k is None else poses[k]


def inverse(T: Transform) -> Transform:
    """Inverse of rigid transformations (..., 4, 4)."""
    back = np.swapaxes(T[..., :3, :3], -1, -2)
    result = np.zeros_like(T)
    result[..., :3, :3] = back
    result[..., :3, 3:] = -back @ T[..., :3, 3:]
    result[..., 3, 3] = 1.0
    return result


def read_transforms(
    topics: Iterable[Topic], decoder: Decoder, stamps: Stamps
) -> tuple[TransformTree, list[str]]:
    """Read /tf and /tf_static into a tree at the given frames.

    Args:
        topics: of the file; those used as poses are read.
        decoder: of the file.
        stamps: (K,) nanoseconds of the recording's frames.

    Returns:
        The tree, and warnings about frames that could not be used.
    """
    parents: dict[str, str] = {}
    samples = {Use.STATIC_TRANSFORMS: _Samples(), Use.TRANSFORMS: _Samples()}
    others: dict[str, str] = {}
    for topic in topics:
        if topic.use not in samples:
            continue
        into = samples[topic.use]
        for message in decoder.messages(topic.channel):
            for transform in message.transforms:
                child = transform.child_frame_id.lstrip("/")
                parent = transform.header.frame_id.lstrip("/")
                if parents.setdefault(child, parent) != parent:
                    others.setdefault(child, parent)
                    continue
                into.add(child, transform)

    fixed, moving = (each.tracks() for each in samples.values())
    lost = [child for child in parents if child not in fixed and child not in moving]
    for child in lost:
        del parents[child]
    tree = TransformTree(parents, _Poses(fixed, moving, stamps))
    warnings = [
        f"Frame {child} has two parents, {parents[child]} and {other}; the second is left out."
        for child, other in list(others.items())[:_TOLD]
        if child in parents
    ]
    if len(others) > _TOLD:
        warnings.append(f"{len(others) - _TOLD} more frames have two parents.")
    if lost:
        warnings.append(f"No pose of {few(lost)} in /tf is usable.")
    if tree.cut:
        warnings.append(f"The poses in /tf go round in a circle above {few(tree.cut)}.")
    return tree, warnings


class _Samples:
    """Poses of frames as they are read, in flat arrays: there may be millions."""

    def __init__(self) -> None:
        self._numbers: dict[str, int] = {}
        self._of, self._stamps, self._values = array("q"), array("q"), array("d")

    def add(self, child: str, stamped: Any) -> None:  # noqa: ANN401 (TransformStamped)
        """Add a pose of a frame."""
        t, q = stamped.transform.translation, stamped.transform.rotation
        self._of.append(self._numbers.setdefault(child, len(self._numbers)))
        self._stamps.append(stamp_of(stamped))
        self._values.extend((t.x, t.y, t.z, q.x, q.y, q.z, q.w))

    def tracks(self) -> dict[str, PoseTrack]:
        """{frame: its track} of the frames with a usable pose."""
        values = np.array(self._values, dtype=np.float64).reshape(-1, 7)
        of, stamps = np.array(self._of, np.int64), np.array(self._stamps, np.int64)
        tracks = pose_tracks(of, stamps, values[:, :3], values[:, 3:])
        return {name: tracks[n] for name, n in self._numbers.items() if n in tracks}


class _Poses(Mapping[str, Transform]):
    """Poses of frames at the frames of a recording, computed where they are asked for.

    Args:
        fixed: {frame: track} of /tf_static, whose last pose counts.
        moving: {frame: track} of /tf; a frame in both counts as moving.
        stamps: (K,) nanoseconds of the recording's frames.
    """

    def __init__(
        self, fixed: Mapping[str, PoseTrack], moving: Mapping[str, PoseTrack], stamps: Stamps
    ) -> None:
        self._moving, self._stamps, self._computed = moving, stamps, 0
        self._known = dict(zip(fixed, last_poses(list(fixed.values()))[:, None], strict=True))
        for frame in moving:
            self._known.pop(frame, None)

    def __getitem__(self, frame: str) -> Transform:
        """Poses of a frame; RecordingError where there are too many."""
        if frame not in self._known:
            self._computed += 1
            if self._computed * len(self._stamps) > MOST_POSES:
                raise RecordingError(
                    f"/tf moves more than {self._computed - 1} frames that place the sensors, "
                    f"and there may be {MOST_POSES} poses; give the file in parts."
                )
            self._known[frame] = self._moving[frame].at(self._stamps)
        return self._known[frame]

    def __iter__(self) -> Iterator[str]:
        return iter({**self._known, **self._moving})

    def __len__(self) -> int:
        return len({**self._known, **self._moving})
