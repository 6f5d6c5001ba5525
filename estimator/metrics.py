"""How far a flow is from the truth, pooled over the points and pairs of a recording."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from estimator.flow import SceneFlow

MOVING_SPEED = 0.01
"""m/s above which something truly moves."""


@dataclass(frozen=True)
class Metrics:
    """Errors pooled over all points and pairs; NaN where nothing defines them.

    Attributes:
        pairs: pairs that count, those without any flow included.
        points_with_flow: source points with a flow in all of them.
        angle_deg: mean angle between each flow and the moving object's velocity, degrees; a flow
            of exactly zero has no direction and is left out (paper, section IV).
        velocity_error: mean length of their difference, m/s (paper, section IV).
        coverage: truly moving points that got a flow / truly moving points.
        precision: points with a flow that truly move / points with a flow.
        epe3d: end-point error, mean distance between where a source point goes by its flow and by
            its own truth, metres per pair; a point without a flow stays. Definition as in
            FlowNet3D and its successors.
    """

    pairs: int
    points_with_flow: int
    angle_deg: float
    velocity_error: float
    coverage: float
    precision: float
    epe3d: float


class PooledErrors:
    """Collects the errors of pair after pair."""

    def __init__(self) -> None:
        self._pairs = 0
        self._angles = _Mean()
        self._velocity_errors = _Mean()
        self._coverage = _Mean()
        self._precision = _Mean()
        self._end_points = _Mean()
        self._means = (
            self._angles,
            self._velocity_errors,
            self._coverage,
            self._precision,
            self._end_points,
        )

    def add(
        self,
        flow: SceneFlow,
        interval: float,
        object_velocity: NDArray[np.float64],
        point_velocity: NDArray[np.float64] | None,
    ) -> None:
        """Add one pair.

        Args:
            flow: of N source points.
            interval: seconds between the two stamps.
            object_velocity: (N, 3) m/s of the moving object, whatever each point belongs to.
            point_velocity: (N, 3) m/s of each point itself, NaN where unknown; None without.
        """
        self._pairs += 1
        moving = flow.moving
        estimated, true = flow.velocity[moving], object_velocity[moving]
        self._angles.add(angles_deg(estimated, true))
        self._velocity_errors.add(np.linalg.norm(estimated - true, axis=1))
        if point_velocity is None:
            return
        known = np.isfinite(point_velocity).all(axis=1)
        truly_moving = np.linalg.norm(point_velocity[known], axis=1) > MOVING_SPEED
        self._coverage.add(moving[known][truly_moving])
        self._precision.add(truly_moving[moving[known]])
        moved_by_flow = np.where(moving[:, None], flow.velocity, 0.0)[known]
        errors = np.linalg.norm(moved_by_flow - point_velocity[known], axis=1)
        self._end_points.add(errors * interval)

    @property
    def sums(self) -> NDArray[np.float64]:
        """(11,) what was added so far, to `include` it elsewhere: pairs, and sum, count of each."""
        return np.array([self._pairs, *(v for m in self._means for v in (m.sum, m.count))])

    def include(self, sums: NDArray[np.float64]) -> None:
        """Add the pairs of another collection, by its `sums` (11,)."""
        self._pairs += int(sums[0])
        for mean, (total, count) in zip(self._means, sums[1:].reshape(-1, 2), strict=True):
            mean.sum += float(total)
            mean.count += int(count)

    def metrics(self) -> Metrics:
        """The errors of all pairs added so far."""
        return Metrics(
            pairs=self._pairs,
            points_with_flow=self._velocity_errors.count,
            angle_deg=self._angles.value,
            velocity_error=self._velocity_errors.value,
            coverage=self._coverage.value,
            precision=self._precision.value,
            epe3d=self._end_points.value,
        )


def angles_deg(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Angles (N,) in degrees between vectors (N, 3), NaN where one has no length."""
    # atan2 keeps its accuracy at small angles, where the paper's acos loses half the digits.
    across = np.linalg.norm(np.cross(a, b), axis=1)
    along = np.einsum("ij,ij->i", a, b)
    lengths = np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1)
    return np.where(lengths > 0, np.degrees(np.arctan2(across, along)), np.nan)


class _Mean:
    """A mean over values that come in pieces; values that are NaN are left out."""

    def __init__(self) -> None:
        self.sum = 0.0
        self.count = 0

    def add(self, values: NDArray[np.float64] | NDArray[np.bool_]) -> None:
        good = np.asarray(values, dtype=np.float64)
        good = good[np.isfinite(good)]
        self.sum += float(good.sum())
        self.count += len(good)

    @property
    def value(self) -> float:
        return self.sum / self.count if self.count else math.nan
