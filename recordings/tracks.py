"""Interpolation of sampled poses and vectors at other times."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Stamps = NDArray[np.int64]
FARTHEST = 1e8
"""Metres, metres per second or radians, beyond which a recorded number is no measurement.

Coordinates from the centre of the Earth stay below; squares of larger ones overflow in the end.
"""


@dataclass(frozen=True)
class PoseTrack:
    """Sampled pose over time.

    Attributes:
        stamps: (N,) nanoseconds, strictly increasing.
        translation: (N, 3) metres.
        rotation: (N, 4) unit quaternions x, y, z, w.
    """

    stamps: Stamps
    translation: NDArray[np.float64]
    rotation: NDArray[np.float64]

    def near(self, stamps: Stamps) -> "PoseTrack":
        """The samples that `at` needs for stamps (K,): the two around each."""
        after = np.searchsorted(self.stamps, stamps, side="left")
        before = np.searchsorted(self.stamps, stamps, side="right") - 1
        rows = np.unique(np.clip([before, after], 0, len(self.stamps) - 1))
        return PoseTrack(self.stamps[rows], self.translation[rows], self.rotation[rows])

    def at(self, stamps: Stamps) -> NDArray[np.float64]:
        """Poses (K, 4, 4), linear in position and slerp in rotation, NaN outside the track."""
        from scipy.spatial.transform import Rotation, Slerp

        poses = np.full((len(stamps), 4, 4), np.nan)
        known = (stamps >= self.stamps[0]) & (stamps <= self.stamps[-1])
        if not known.any():
            return poses
        times, apart = _times(self.stamps)
        wanted = (stamps[known] - self.stamps[0]) * 1e-9
        poses[known] = np.eye(4)
        poses[known, :3, 3] = _linear(wanted, times, self.translation[apart])
        if len(times) > 1:
            rotations = Slerp(times, Rotation.from_quat(self.rotation[apart]))(wanted)
            poses[known, :3, :3] = rotations.as_matrix()
        else:
            poses[known, :3, :3] = Rotation.from_quat(self.rotation[0]).as_matrix()
        return poses


def pose_track(
    stamps: NDArray[np.int64], translation: NDArray[np.float64], rotation: NDArray[np.float64]
) -> PoseTrack | None:
    """Make a track of poses in any order; of equal stamps the last is used.

    Poses that are not finite, farther than `FARTHEST`, or have a zero quaternion are left out; None
    where none is left.
    """
    tracks = pose_tracks(np.zeros(len(stamps), dtype=np.int64), stamps, translation, rotation)
    return tracks.get(0)


def pose_tracks(
    of: NDArray[np.int64],
    stamps: NDArray[np.int64],
    translation: NDArray[np.float64],
    rotation: NDArray[np.float64],
) -> dict[int, PoseTrack]:
    """Make the tracks of several frames at once, as `pose_track` does of one.

    Args:
        of: (N,) number of the frame that each pose is of.
        stamps: (N,) nanoseconds.
        translation: (N, 3) metres.
        rotation: (N, 4) quaternions x, y, z, w.

    Returns:
        {number: track} of the frames with a usable pose.
    """
    with np.errstate(over="ignore", invalid="ignore"):  # an infinite length is none, nor is NaN
        length = np.linalg.norm(rotation, axis=1)
    near = (np.abs(translation) <= FARTHEST).all(axis=1)
    good = np.flatnonzero(near & np.isfinite(length) & (length > 1e-6))
    if len(good) == 0:
        return {}
    rows = good[np.lexsort((stamps[good], of[good]))]  # stable: the last of equals is the latest
    following = np.append(rows[1:], -1)
    last = (of[rows] != of[following]) | (stamps[rows] != stamps[following])
    last[-1] = True
    rows = rows[last]
    numbers, starts = np.unique(of[rows], return_index=True)
    stamps, translation = stamps[rows], translation[rows]
    rotation = rotation[rows] / length[rows, None]
    ends = [*starts[1:].tolist(), len(rows)]
    return {
        number: PoseTrack(stamps[start:end], translation[start:end], rotation[start:end])
        for number, start, end in zip(numbers.tolist(), starts.tolist(), ends, strict=True)
    }


def last_poses(tracks: Sequence[PoseTrack]) -> NDArray[np.float64]:
    """Last pose (N, 4, 4) of each of several tracks."""
    from scipy.spatial.transform import Rotation

    poses = np.tile(np.eye(4), (len(tracks), 1, 1))
    if tracks:
        poses[:, :3, 3] = [track.translation[-1] for track in tracks]
        poses[:, :3, :3] = Rotation.from_quat([t.rotation[-1] for t in tracks]).as_matrix()
    return poses


@dataclass(frozen=True)
class VectorTrack:
    """Sampled vector over time, such as a velocity.

    Attributes:
        stamps: (N,) nanoseconds, strictly increasing.
        values: (N, D).
    """

    stamps: Stamps
    values: NDArray[np.float64]

    def at(self, stamps: Stamps) -> NDArray[np.float64]:
        """Values (K, D), linear between the samples.

        The first and the last sample hold for one more sampling period; NaN further outside.
        """
        times, samples, _ = self._samples
        values = _linear((stamps - self.stamps[0]) * 1e-9, times, samples)
        values[~self.covers(stamps)] = np.nan
        return values

    def rotated(self, rotation: NDArray[np.float64]) -> "VectorTrack":
        """The track in another frame, by the rotation (3, 3) into it."""
        return VectorTrack(self.stamps, self.values @ rotation.T)

    def covers(self, stamps: Stamps) -> NDArray[np.bool_]:
        """(K,) where `at` knows the values."""
        times, _, margin = self._samples
        wanted = (stamps - self.stamps[0]) * 1e-9
        return (wanted >= -margin) & (wanted <= times[-1] + margin)

    def mean(self, start: int, end: int) -> NDArray[np.float64]:
        """Mean (D,) over the time from `start` to `end` (nanoseconds), NaN where it is unknown."""
        inside = self.stamps[(self.stamps > start) & (self.stamps < end)]
        stamps = np.concatenate([[start], inside, [end]])
        times = (stamps - start) * 1e-9
        return np.trapezoid(self.at(stamps), times, axis=0) / times[-1]

    @cached_property
    def _samples(self) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
        """Seconds (M,) from the first stamp, values (M, D), and the sampling period in seconds."""
        times, apart = _times(self.stamps)
        return times, self.values[apart], _margin(times)


class VectorsAtFrames:
    """Sampled vector at the frames of a recording.

    Args:
        track: of the vector.
        stamps: (K,) nanoseconds of the frames.
    """

    def __init__(self, track: VectorTrack, stamps: Stamps) -> None:
        self._track, self._stamps, self._values = track, stamps, track.at(stamps)

    def at_frame(self, k: int) -> NDArray[np.float64]:
        """Value (D,) at a frame, NaN where unknown."""
        return self._values[k]

    def mean(self, source_k: int, target_k: int) -> NDArray[np.float64]:
        """Mean (D,) over the time between two frames, NaN where unknown."""
        return self._track.mean(int(self._stamps[source_k]), int(self._stamps[target_k]))


def vector_track(stamps: NDArray[np.int64], values: NDArray[np.float64]) -> VectorTrack | None:
    """Make a track of vectors in any order; of equal stamps the last is used.

    Vectors that are not finite or larger than `FARTHEST` are left out; None where none is left.
    """
    good = (np.abs(values) <= FARTHEST).all(axis=1)
    stamps, values = stamps[good], values[good]
    if len(stamps) == 0:
        return None
    _, last = np.unique(stamps[::-1], return_index=True)
    rows = len(stamps) - 1 - last
    return VectorTrack(stamps[rows], values[rows])


def vector_tracks(
    of: NDArray[np.int64], stamps: NDArray[np.int64], values: NDArray[np.float64]
) -> dict[int, VectorTrack]:
    """{number: its track} of vectors (N, D) of several numbers (N,), as `vector_track` makes it."""
    order = np.argsort(of, kind="stable")
    numbers, starts = np.unique(of[order], return_index=True)
    parts = np.split(order, starts[1:])
    tracks = {
        number: vector_track(stamps[part], values[part])
        for number, part in zip(numbers.tolist(), parts, strict=False)
    }
    return {number: track for number, track in tracks.items() if track is not None}


def _margin(times: NDArray[np.float64]) -> float:
    """Sampling period, for which the first and the last sample hold further."""
    return float(np.median(np.diff(times))) if len(times) > 1 else 0.0


def _times(stamps: Stamps) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Seconds (M,) from the first stamp, since nanoseconds since 1970 do not fit a float.

    After a first stamp of 0, stamps of today less than 240 ns apart are the same number of seconds.

    Returns:
        The seconds, strictly increasing, and (N,) whether a sample is one of those.
    """
    times = (stamps - stamps[0]) * 1e-9
    apart = np.diff(times, prepend=-1.0) > 0
    return times[apart], apart


def _linear(
    wanted: NDArray[np.float64], times: NDArray[np.float64], values: NDArray[np.float64]
) -> NDArray[np.float64]:
    return np.stack([np.interp(wanted, times, column) for column in values.T], axis=-1)
