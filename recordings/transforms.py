"""Transform tree of /tf and /tf_static."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from recordings.contents import Topic, Use
from recordings.decoding import Decoder, stamp_of
from recordings.tracks import PoseTrack, Stamps, pose_track

Transform = NDArray[np.float64]
_STILL = 1e-3  # metres, and rad of small angles


@dataclass
class _Samples:
    stamps: list[int] = field(default_factory=list)
    translation: list[tuple[float, float, float]] = field(default_factory=list)
    rotation: list[tuple[float, float, float, float]] = field(default_factory=list)

    def track(self) -> PoseTrack | None:
        return pose_track(
            np.array(self.stamps, dtype=np.int64),
            np.array(self.translation, dtype=np.float64).reshape(-1, 3),
            np.array(self.rotation, dtype=np.float64).reshape(-1, 4),
        )


class TransformTree:
    """Poses of frames relative to each other at the frames of a recording.

    Args:
        parents: {frame: its parent}.
        poses: {frame: T_parent_frame, (K, 4, 4) over the recording's frames or (1, 4, 4) where it
            is constant, NaN where unknown}.
    """

    def __init__(self, parents: Mapping[str, str], poses: Mapping[str, Transform]) -> None:
        self._parents = dict(parents)
        self._poses = dict(poses)

    @property
    def frames(self) -> set[str]:
        """All frames of the tree."""
        return set(self._parents) | set(self._parents.values())

    def root_of(self, frame: str) -> str:
        """Root of the tree that contains `frame`."""
        return self.path_to_root(frame)[-1]

    def path_to_root(self, frame: str) -> list[str]:
        """`frame` and its ancestors up to the root; a loop is cut where it closes."""
        path = [frame]
        while (parent := self._parents.get(path[-1])) is not None and parent not in path:
            path.append(parent)
        return path

    def connected(self, a: str, b: str) -> bool:
        """Whether a chain of poses leads from `a` to `b`."""
        return a == b or bool(set(self.path_to_root(a)) & set(self.path_to_root(b)))

    def moves(self, a: str, b: str) -> bool:
        """Whether the pose between two connected frames changes over the recording.

        Changes within a millimetre and a milliradian are noise of measured poses.
        """
        up, down = self._branches(a, b)
        changing = [frame for frame in [*up, *down] if len(self._poses[frame]) > 1]
        if not changing:
            return False
        poses = self.over(a, b, len(self._poses[changing[0]]))
        known = poses[np.isfinite(poses).all(axis=(1, 2))]
        return len(known) == 0 or bool(np.ptp(known, axis=0).max() > _STILL)

    def transform(self, a: str, b: str, k: int) -> Transform:
        """T_a_b (4, 4) at frame `k`, NaN where it is unknown or the frames are not connected."""
        return self._between(a, b, k)

    def over(self, a: str, b: str, frames: int) -> Transform:
        """T_a_b (K, 4, 4) at the first `frames` frames, NaN where unknown."""
        return np.broadcast_to(self._between(a, b, slice(frames)), (frames, 4, 4)).copy()

    def known(self, a: str, b: str, frames: int) -> NDArray[np.bool_]:
        """(K,) whether T_a_b is known at the first `frames` frames."""
        return np.asarray(np.isfinite(self.over(a, b, frames)).all(axis=(1, 2)))

    def _between(self, a: str, b: str, frames: int | slice) -> Transform:
        """T_a_b (4, 4) at a frame, or (K, 4, 4) at several, (4, 4) where it is constant."""
        if not self.connected(a, b):
            return np.full((4, 4), np.nan)
        up, down = self._branches(a, b)
        return inverse(self._chain(up, frames)) @ self._chain(down, frames)

    def _branches(self, a: str, b: str) -> tuple[list[str], list[str]]:
        """Frames from `a`, and from `b`, up to below their lowest common ancestor."""
        path_a, path_b = self.path_to_root(a), self.path_to_root(b)
        common = next(frame for frame in path_a if frame in path_b)
        return path_a[: path_a.index(common)], path_b[: path_b.index(common)]

    def _chain(self, branch: Iterable[str], frames: int | slice) -> Transform:
        T: Transform = np.eye(4)
        for frame in branch:
            poses = self._poses[frame]
            T = poses[frames if len(poses) > 1 else 0] @ T
        return T


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
    moving: dict[str, _Samples] = {}
    fixed: dict[str, _Samples] = {}
    warnings: list[str] = []
    for topic in topics:
        if topic.use not in (Use.TRANSFORMS, Use.STATIC_TRANSFORMS):
            continue
        into = fixed if topic.use is Use.STATIC_TRANSFORMS else moving
        for message in decoder.messages(topic.channel):
            for transform in message.transforms:
                child = transform.child_frame_id.lstrip("/")
                parent = transform.header.frame_id.lstrip("/")
                if parents.setdefault(child, parent) != parent:
                    warnings.append(
                        f"Frame {child} has two parents, {parents[child]} and {parent}; "
                        f"the second is left out."
                    )
                    continue
                _add(into.setdefault(child, _Samples()), transform)

    poses: dict[str, Transform] = {}
    for child in list(parents):
        track = (moving.get(child) or fixed[child]).track()
        if track is None:
            warnings.append(f"Frame {child} has no usable pose.")
            del parents[child]
        elif child in moving:
            poses[child] = track.at(stamps)
        else:
            poses[child] = track.at(track.stamps[-1:])
    return TransformTree(parents, poses), list(dict.fromkeys(warnings))


def _add(samples: _Samples, stamped: object) -> None:
    transform = stamped.transform  # type: ignore[attr-defined]
    t, q = transform.translation, transform.rotation
    samples.stamps.append(stamp_of(stamped))
    samples.translation.append((t.x, t.y, t.z))
    samples.rotation.append((q.x, q.y, q.z, q.w))
