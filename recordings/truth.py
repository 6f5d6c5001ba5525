"""Truth of the moving object's motion."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from recordings.nearby import Column
from recordings.tracks import Stamps, VectorsAtFrames, VectorTrack
from recordings.transforms import inverse
from recordings.truth_nearby import TwistNearby


@dataclass(frozen=True)
class PairTruth:
    """Truth over a pair, as the mean over its interval; a recording's arrays are read-only.

    Attributes:
        velocity: (N, 3) m/s of the moving object, as if each source point belonged to it; a
            rotating object carries every point round with it.
        points: (N, 3) m/s of each source point itself, zero where static, NaN where unknown;
            None where the recording has no truth of points.
    """

    velocity: NDArray[np.float64]
    points: NDArray[np.float64] | None


class ObjectTruth(Protocol):
    """Motion of the moving object in the fixed frame."""

    def at(self, k: int) -> NDArray[np.float64] | None:
        """Velocity (3,) m/s at frame `k`, None where unknown."""
        ...

    def over(
        self, source_k: int, target_k: int, points: NDArray[np.float64]
    ) -> NDArray[np.float64] | None:
        """Mean velocity (N, 3) m/s of `points` (N, 3) of the object at the source frame."""
        ...


class TwistTruth:
    """Object with a recorded velocity, assumed to be in pure translation.

    Args:
        track: velocity in the fixed frame, or, of a long recording, its parts around frames.
        stamps: (K,) nanoseconds of the frames.
        rotates: whether the recorded twist has, or may have, an angular velocity.

    Attributes:
        rotates: as given.
    """

    def __init__(
        self, track: VectorTrack | TwistNearby, stamps: Stamps, rotates: bool = False
    ) -> None:
        self.rotates = rotates
        self._velocity = VectorsAtFrames(track, stamps) if isinstance(track, VectorTrack) else track

    def at(self, k: int) -> NDArray[np.float64] | None:
        """Velocity (3,) m/s at frame `k`, None outside the track."""
        velocity = self._velocity.at_frame(k)
        return velocity if np.isfinite(velocity).all() else None

    def over(
        self, source_k: int, target_k: int, points: NDArray[np.float64]
    ) -> NDArray[np.float64] | None:
        """Mean velocity (N, 3) m/s between two frames, the same for every point."""
        mean = self._velocity.mean(source_k, target_k)
        return np.broadcast_to(mean, points.shape) if np.isfinite(mean).all() else None

    def may_turn(self, source_k: int, target_k: int) -> bool:
        """Whether it may rotate between two frames; looked at in a long recording alone."""
        if isinstance(self._velocity, TwistNearby):
            return self._velocity.turns(source_k, target_k)
        return True


class RigidTruth:
    """Object that moves rigidly with a frame whose pose was recorded.

    Args:
        T_fixed_object: (K, 4, 4) at the frames, NaN where unknown; or a `Column` of them.
        stamps: (K,) nanoseconds of the frames.
    """

    def __init__(self, T_fixed_object: NDArray[np.float64] | Column, stamps: Stamps) -> None:
        self._poses = T_fixed_object
        self._seconds = (stamps - stamps[0]) * 1e-9

    def at(self, k: int) -> NDArray[np.float64] | None:
        """Velocity (3,) m/s of the frame's origin at frame `k`, None where unknown.

        Central difference of the neighbouring frames, one-sided at the ends.
        """
        before, after = max(k - 1, 0), min(k + 1, len(self._seconds) - 1)
        if before == after:
            return None
        step = self._poses[after][:3, 3] - self._poses[before][:3, 3]
        velocity = step / (self._seconds[after] - self._seconds[before])
        return velocity if np.isfinite(velocity).all() else None

    def over(
        self, source_k: int, target_k: int, points: NDArray[np.float64]
    ) -> NDArray[np.float64] | None:
        """Displacement of each point, carried along rigidly, per interval: (N, 3) m/s."""
        motion = self._poses[target_k] @ inverse(self._poses[source_k])
        if not np.isfinite(motion).all():
            return None
        moved = points @ motion[:3, :3].T + motion[:3, 3]
        return (moved - points) / (self._seconds[target_k] - self._seconds[source_k])

    def rates(self, k: int, points: NDArray[np.float64]) -> NDArray[np.float64] | None:
        """Velocity (N, 3) m/s of points carried along rigidly, at frame `k`."""
        if k + 1 < len(self._seconds):
            return self.over(k, k + 1, points)
        return self.over(k, k - 1, points) if k > 0 else None


class TurningTruth:
    """Rotating object whose velocity and pose were recorded.

    Args:
        twist: velocity of the object's origin.
        rigid: its pose, which carries the points along.
    """

    def __init__(self, twist: TwistTruth, rigid: RigidTruth) -> None:
        self._twist, self._rigid = twist, rigid

    def at(self, k: int) -> NDArray[np.float64] | None:
        """Velocity (3,) m/s of the origin at frame `k`, None where unknown."""
        return self._twist.at(k)

    def over(
        self, source_k: int, target_k: int, points: NDArray[np.float64]
    ) -> NDArray[np.float64] | None:
        """Displacement of each point, carried along rigidly, per interval: (N, 3) m/s."""
        if not self._twist.may_turn(source_k, target_k):
            return self._twist.over(source_k, target_k, points)
        carried = self._rigid.over(source_k, target_k, points)
        return self._twist.over(source_k, target_k, points) if carried is None else carried
