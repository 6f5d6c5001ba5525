"""Interpolation of sampled poses and vectors at other times."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation, Slerp

Stamps = NDArray[np.int64]


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

    def at(self, stamps: Stamps) -> NDArray[np.float64]:
        """Poses (K, 4, 4), linear in position and slerp in rotation, NaN outside the track."""
        poses = np.full((len(stamps), 4, 4), np.nan)
        known = (stamps >= self.stamps[0]) & (stamps <= self.stamps[-1])
        if not known.any():
            return poses
        # Seconds from the start: nanoseconds since 1970 do not fit a float.
        times = (self.stamps - self.stamps[0]) * 1e-9
        wanted = (stamps[known] - self.stamps[0]) * 1e-9
        poses[known] = np.eye(4)
        poses[known, :3, 3] = _linear(wanted, times, self.translation)
        if len(times) > 1:
            rotations = Slerp(times, Rotation.from_quat(self.rotation))(wanted)
            poses[known, :3, :3] = rotations.as_matrix()
        else:
            poses[known, :3, :3] = Rotation.from_quat(self.rotation[0]).as_matrix()
        return poses


def pose_track(
    stamps: NDArray[np.int64], translation: NDArray[np.float64], rotation: NDArray[np.float64]
) -> PoseTrack | None:
    """Make a track of poses in any order; of equal stamps the last is used.

    Poses that are not finite or have a zero quaternion are left out; None where none is left.
    """
    length = np.linalg.norm(rotation, axis=1)
    good = np.isfinite(translation).all(axis=1) & np.isfinite(length) & (length > 1e-6)
    stamps, translation = stamps[good], translation[good]
    rotation = rotation[good] / length[good, None]
    if len(stamps) == 0:
        return None
    _, last = np.unique(stamps[::-1], return_index=True)
    rows = len(stamps) - 1 - last
    return PoseTrack(stamps[rows], translation[rows], rotation[rows])


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
        times = (self.stamps - self.stamps[0]) * 1e-9
        wanted = (stamps - self.stamps[0]) * 1e-9
        values = _linear(wanted, times, self.values)
        margin = float(np.median(np.diff(times))) if len(times) > 1 else 0.0
        values[(wanted < -margin) | (wanted > times[-1] + margin)] = np.nan
        return values

    def mean(self, start: int, end: int) -> NDArray[np.float64]:
        """Mean (D,) over the time from `start` to `end` (nanoseconds), NaN where it is unknown."""
        inside = self.stamps[(self.stamps > start) & (self.stamps < end)]
        stamps = np.concatenate([[start], inside, [end]])
        times = (stamps - start) * 1e-9
        return np.trapezoid(self.at(stamps), times, axis=0) / times[-1]


def vector_track(stamps: NDArray[np.int64], values: NDArray[np.float64]) -> VectorTrack | None:
    """Make a track of vectors in any order; of equal stamps the last is used. None where empty."""
    good = np.isfinite(values).all(axis=1)
    stamps, values = stamps[good], values[good]
    if len(stamps) == 0:
        return None
    _, last = np.unique(stamps[::-1], return_index=True)
    rows = len(stamps) - 1 - last
    return VectorTrack(stamps[rows], values[rows])


def _linear(
    wanted: NDArray[np.float64], times: NDArray[np.float64], values: NDArray[np.float64]
) -> NDArray[np.float64]:
    return np.stack([np.interp(wanted, times, column) for column in values.T], axis=-1)
