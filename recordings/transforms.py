"""Transform tree of /tf and /tf_static."""

from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from recordings.contents import Topic, Use
from recordings.decoding import Decoder
from recordings.errors import few
from recordings.nearby import Column, FramePlaces
from recordings.tracks import Stamps
from recordings.transform_samples import Parents, TransformSamples, WholePoses
from recordings.transforms_nearby import TransformsNearby

Transform = NDArray[np.float64]
_STILL = 1e-3  # metres, and rad of small angles
_LOOKED_AT = 32  # frames of a long recording
_TOLD = 8  # frames with two parents that are named
_SEGMENT = 256
"""Frames of a chain whose product is kept; the trees of robots are not as deep."""


class TransformTree:
    """Poses of frames relative to each other at the frames of a recording.

    Args:
        parents: {frame: its parent}; loops are cut, see `cut`.
        poses: {frame: T_parent_frame, (K, 4, 4) over the recording's frames or (1, 4, 4) where it
            is constant, NaN where unknown; or a `Column` of a long recording}.

    Attributes:
        frames: all frames of the tree.
        cut: frames whose parent is left out because it lies below them.
    """

    def __init__(self, parents: Mapping[str, str], poses: Mapping[str, Transform | Column]) -> None:
        self._parents = dict(parents)
        self._poses = poses
        self._on_demand = isinstance(poses, dict) and any(
            isinstance(each, Column) for each in poses.values()
        )
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

        Changes within a millimetre and a milliradian are noise of measured poses. Of a long
        recording some frames are looked at.
        """
        columns = self._columns(a, b)
        if columns:
            looked_at = np.linspace(0, len(columns[0]) - 1, _LOOKED_AT).astype(int).tolist()
            poses = np.stack([self.transform(a, b, k) for k in looked_at])
        else:
            changing = [len(poses) for poses in self._way(a, b) if poses.ndim == 3]
            if not changing:
                return False
            poses = self.over(a, b, changing[0])
        known = poses[np.isfinite(poses).all(axis=(1, 2))]
        return len(known) == 0 or bool(np.ptp(known, axis=0).max() > _STILL)

    def transform(self, a: str, b: str, k: int) -> Transform:
        """T_a_b (4, 4) at frame `k`, NaN where it is unknown or the frames are not connected."""
        return self._relative(a, b, k)

    def pose(self, frame: str, k: int) -> Transform:
        """Pose (4, 4) of a frame in its parent at frame `k` of the recording, NaN where unknown."""
        return self._pose(frame, k)

    def chain_up(self, frame: str, ancestor: str, most: int) -> list[str] | None:
        """Frames from one up to below an ancestor; None where it is none, or there are more."""
        if not self.connected(ancestor, frame) or self._common(ancestor, frame) != ancestor:
            return None
        if self._depth.get(frame, 0) - self._depth.get(ancestor, 0) > most:
            return None
        return list(self._frames_up(frame, ancestor))

    def over(self, a: str, b: str, frames: int) -> Transform:
        """T_a_b (K, 4, 4) at the first `frames` frames, NaN where unknown."""
        poses = self._relative(a, b, None)
        return np.broadcast_to(poses if poses.ndim == 2 else poses[:frames], (frames, 4, 4)).copy()

    def poses(self, a: str, b: str, frames: int) -> Transform | Column:
        """As `over`, or, of a long recording, computed where they are asked for."""
        if not self._columns(a, b):
            return self.over(a, b, frames)
        return Column(lambda k: self.transform(a, b, k), self.known(a, b, frames))

    def known(self, a: str, b: str, frames: int) -> NDArray[np.bool_]:
        """(K,) whether T_a_b is known at the first `frames` frames."""
        known = np.full(frames, self.connected(a, b))
        if columns := self._columns(a, b):
            return known & np.all([column.known[:frames] for column in columns], axis=0)
        for poses in self._way(a, b):
            finite = np.asarray(np.isfinite(poses).all(axis=(-2, -1)))
            known &= finite if finite.ndim == 0 else finite[:frames]
        return known

    def _columns(self, a: str, b: str) -> list[Column]:
        """Poses between two frames that are computed where they are asked for."""
        if not (self._on_demand and self.connected(a, b)):
            return []
        common = self._common(a, b)
        frames = [*self._frames_up(a, common), *self._frames_up(b, common)]
        return [poses for f in frames if isinstance(poses := self._poses[f], Column)]

    def _frames_up(self, frame: str, ancestor: str) -> Iterator[str]:
        """Frames from one up to below an ancestor."""
        while frame != ancestor:
            yield frame
            frame = self._parents[frame]

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
        return np.asarray(poses) if k is None else poses[k]


def inverse(T: Transform) -> Transform:
    """Inverse of rigid transformations (..., 4, 4)."""
    back = np.swapaxes(T[..., :3, :3], -1, -2)
    result = np.zeros_like(T)
    result[..., :3, :3] = back
    result[..., :3, 3:] = -back @ T[..., :3, 3:]
    result[..., 3, 3] = 1.0
    return result


def read_transforms(
    topics: Iterable[Topic],
    decoder: Decoder,
    stamps: Stamps,
    places: FramePlaces | None = None,
) -> tuple[TransformTree, list[str]]:
    """Read /tf and /tf_static into a tree at the given frames.

    Where /tf of a long recording has many messages, its poses are read around the frames that are
    asked for; see `TransformsNearby`.

    Args:
        topics: of the file; those used as poses are read.
        decoder: of the file.
        stamps: (K,) nanoseconds of the recording's frames.
        places: of the frames of a long recording.

    Returns:
        The tree, and warnings about frames that could not be used.
    """
    parents = Parents()
    uses = (Use.STATIC_TRANSFORMS, Use.TRANSFORMS)
    samples = {use: TransformSamples(parents) for use in uses}
    topics = [topic for topic in topics if topic.use in samples]
    nearby = _nearby(topics, places, parents)
    for topic in topics:
        if topic.use is Use.STATIC_TRANSFORMS and places and places.is_long(topic.channel):
            samples[topic.use].add_ends(places, topic.channel)
        elif not (nearby and topic.use is Use.TRANSFORMS):
            samples[topic.use].add(decoder, topic.channel)
    fixed, moving = (each.tracks() for each in samples.values())
    poses: Mapping[str, Transform | Column] = WholePoses(fixed, moving, stamps)
    if nearby:
        poses = {**poses, **nearby.columns()}
    lost = [child for child in parents.first if child not in poses]
    placed = {child: parent for child, parent in parents.first.items() if child in poses}
    tree = TransformTree(placed, poses)
    return tree, _warnings(placed, parents.others, lost, tree.cut)


def _nearby(
    topics: list[Topic], places: FramePlaces | None, parents: Parents
) -> TransformsNearby | None:
    """The moving frames of a long recording, None where all poses are read at once."""
    moving = [topic for topic in topics if topic.use is Use.TRANSFORMS]
    if places is None or not any(places.is_long(topic.channel) for topic in moving):
        return None
    return TransformsNearby(moving, places, parents)


def _warnings(
    parents: Mapping[str, str], others: Mapping[str, str], lost: list[str], cut: list[str]
) -> list[str]:
    warnings = [
        f"Frame {child} has two parents, {parents[child]} and {other}; the second is left out."
        for child, other in list(others.items())[:_TOLD]
        if child in parents
    ]
    if len(others) > _TOLD:
        warnings.append(f"{len(others) - _TOLD} more frames have two parents.")
    if lost:
        warnings.append(f"No pose of {few(lost)} in /tf is usable.")
    if cut:
        warnings.append(f"The poses in /tf go round in a circle above {few(cut)}.")
    return warnings
