"""Errors of a flow against the truth, pooled over the points and pairs of a recording.

The paper's errors compare every point that has a flow with the velocity of the moving object. The
field's metrics (EPE3D, AccS, AccR, Outliers, dynamic IoU) compare every source point with its own
truth over a pair: `f` is the point's true displacement over the interval in metres, `f_hat` the
estimated one, zero for a point without flow, and

    e = |f_hat - f|        r = e / (|f| + RELATIVE_EPSILON)

The field's thresholds are made for cars and furniture that move metres from one cloud to the next,
and do not suit this scale: at the paper's 0.15 to 0.30 m/s a point moves 0.08 to 0.16 m over n = 8
frames at 15 Hz. AccS accepts an error of 0.05 m, a third to two thirds of that. AccR accepts
0.10 m, which at 0.15 m/s is satisfied without any flow. Every point at rest is a hit in both.
Outliers reduces to r > 0.10 and counts every point at rest that has a flow. Argoverse 2 calls
motion below 0.5 m/s static; all motions of the paper are slower. Use these metrics to compare
methods on the same recordings, together with coverage and precision.
"""

import math
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from estimator.flow import SceneFlow
from estimator.metric_info import MetricInfo, metric

MOVING_SPEED = 0.01
"""Speed in m/s above which the truth counts as motion."""

STRICT, RELAXED, OUTLYING = 0.05, 0.10, 0.30
"""AccS: e below STRICT metres or r below STRICT; AccR likewise with RELAXED; an outlier: e above
OUTLYING metres or r above RELAXED."""

RELATIVE_EPSILON = 1e-4
"""Metres in the denominator of r, as in HPLFlowNet (Argoverse 2 has 1e-10, ICP-Flow 1e-20)."""


ERROR_SYMBOLS = (
    "e is the length of the difference between a point's estimated displacement over a pair (zero "
    "without a flow) and its true one, r is e divided by the length of the true one"
)
"""What `e` and `r` in definitions of metrics mean."""


@dataclass(frozen=True)
class Metrics:
    """Errors pooled over all points and pairs; NaN where undefined.

    A pair counts where the object moves at both its frames. Values are means over all points of
    all pairs that count, not means of the pairs' means; only `false_flow` includes the other pairs.
    A point whose own truth is unknown enters only the paper's errors. `METRIC_INFO` defines each.
    """

    pairs: int = metric(
        "pairs",
        "pairs at both frames of which the object moves, also those without any flow",
        kind="count",
    )
    points_with_flow: int = metric(
        "points with flow", "source points with a flow, in all these pairs", kind="count"
    )
    angle_deg: float = metric(
        "angle deviation",
        "mean angle between each flow and the moving object's velocity; a flow of exactly zero "
        "has no direction and is left out",
        "paper, section IV",
        kind="error",
        unit="deg",
        form=".2f",
        plotted=True,
    )
    velocity_error: float = metric(
        "velocity error",
        "mean length of the difference between each flow and the moving object's velocity",
        "paper, section IV",
        kind="error",
        unit="m/s",
        form=".4f",
        plotted=True,
    )
    coverage: float = metric(
        "coverage", "truly moving points that got a flow / truly moving points", plotted=True
    )
    precision: float = metric(
        "precision", "points with a flow that truly move / points with a flow", plotted=True
    )
    epe3d: float = metric(
        "EPE3D",
        "end-point error, mean of e over all points",
        "FlowNet3D (Liu et al., CVPR 2019)",
        kind="error",
        unit="m",
        form=".4f",
    )
    acc_s: float = metric(
        "AccS",
        f"strict accuracy, share of points with e < {STRICT:.2f} m or r < {STRICT:.2f}",
        "HPLFlowNet (Gu et al., CVPR 2019), evaluation_utils.evaluate_3d; the same in Argoverse 2 "
        "and ICP-Flow",
    )
    acc_r: float = metric(
        "AccR",
        f"relaxed accuracy, share of points with e < {RELAXED:.2f} m or r < {RELAXED:.2f}",
        "HPLFlowNet, as AccS",
    )
    outliers: float = metric(
        "outliers",
        f"share of points with e > {OUTLYING:.2f} m or r > {RELAXED:.2f}",
        "HPLFlowNet; ICP-Flow's ROutliers is another: it requires both, with r > 0.30",
        best="least",
    )
    dynamic_iou: float = metric(
        "dynamic IoU",
        "points that truly move and got a flow / points that truly move or got a flow; a point "
        f"truly moves where it is faster than {MOVING_SPEED:g} m/s",
        "evaluation of Argoverse 2, which calls moving what goes 0.05 m per 0.1 s",
    )
    false_flow: float = metric(
        "false flow",
        "points with a flow that do not truly move / points that do not truly move, over all "
        "pairs whose truth is known, also those at which nothing moves",
        form=".4f",
        best="least",
    )


METRIC_INFO: dict[str, MetricInfo] = {f.name: f.metadata["metric"] for f in fields(Metrics)}

_MEANS = tuple(name for name, info in METRIC_INFO.items() if info.kind != "count")


class PooledErrors:
    """Accumulator of errors, pair by pair."""

    def __init__(self) -> None:
        self._counts = {name: 0 for name in METRIC_INFO if name not in _MEANS}
        self._means = {name: _Mean() for name in _MEANS}

    def add(
        self,
        flow: SceneFlow,
        interval: float,
        object_velocity: NDArray[np.float64],
        point_velocity: NDArray[np.float64] | None,
    ) -> None:
        """Add one pair that counts.

        Args:
            flow: of N source points.
            interval: seconds between the two stamps.
            object_velocity: (N, 3) m/s of the moving object, as if each point belonged to it.
            point_velocity: (N, 3) m/s of each point itself, NaN where unknown; None without.
        """
        moving = flow.moving
        estimated, true = flow.velocity[moving], object_velocity[moving]
        self._counts["pairs"] += 1
        velocity_error = np.linalg.norm(estimated - true, axis=1)
        self._counts["points_with_flow"] += int(np.isfinite(velocity_error).sum())
        self._add("angle_deg", angles_deg(estimated, true))
        self._add("velocity_error", velocity_error)
        if point_velocity is None:
            return
        known = _known(point_velocity)
        found, truly = moving[known], truly_moves(point_velocity[known])
        self._add("coverage", found[truly])
        self._add("precision", truly[found])
        self._add("dynamic_iou", (found & truly)[found | truly])
        self._add("false_flow", found[~truly])
        by_flow = np.where(moving[:, None], flow.velocity, 0.0)[known]
        e = np.linalg.norm(by_flow - point_velocity[known], axis=1) * interval
        f = np.linalg.norm(point_velocity[known], axis=1) * interval
        r = e / (f + RELATIVE_EPSILON)
        self._add("epe3d", e)
        self._add("acc_s", (e < STRICT) | (r < STRICT))
        self._add("acc_r", (e < RELAXED) | (r < RELAXED))
        self._add("outliers", (e > OUTLYING) | (r > RELAXED))

    def add_resting(self, flow: SceneFlow, point_velocity: NDArray[np.float64]) -> None:
        """Add one pair that does not count; it changes only the false flow.

        Args:
            flow: of N source points.
            point_velocity: (N, 3) m/s of each point itself, NaN where unknown.
        """
        known = _known(point_velocity)
        self._add("false_flow", flow.moving[known][~truly_moves(point_velocity[known])])

    @property
    def sums(self) -> NDArray[np.float64]:
        """Array for `include`: all counts, then sum and number of values of each mean."""
        means = self._means.values()
        return np.array([*self._counts.values(), *(v for m in means for v in (m.sum, m.count))])

    def include(self, sums: NDArray[np.float64]) -> None:
        """Add the pairs of another accumulator, given its `sums`."""
        counts, means = np.split(sums, [len(self._counts)])
        for name, count in zip(self._counts, counts, strict=True):
            self._counts[name] += int(count)
        for mean, (total, count) in zip(self._means.values(), means.reshape(-1, 2), strict=True):
            mean.sum += float(total)
            mean.count += int(count)

    def metrics(self) -> Metrics:
        """The errors of all pairs added so far."""
        values: dict[str, Any] = {name: mean.value for name, mean in self._means.items()}
        return Metrics(**self._counts, **values)

    def _add(self, name: str, values: NDArray[np.float64] | NDArray[np.bool_]) -> None:
        self._means[name].add(values)


def _known(point_velocity: NDArray[np.float64]) -> NDArray[np.bool_]:
    return np.asarray(np.isfinite(point_velocity).all(axis=1))


def truly_moves(velocity: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Mask (N,) of velocities (N, 3) m/s above `MOVING_SPEED`; False where unknown (NaN)."""
    return np.linalg.norm(velocity, axis=1) > MOVING_SPEED


def angles_deg(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Angles (N,) in degrees between vectors (N, 3), NaN where one is zero."""
    # atan2 keeps its accuracy at small angles, where the paper's acos loses half the digits.
    across = np.linalg.norm(np.cross(a, b), axis=1)
    along = np.einsum("ij,ij->i", a, b)
    lengths = np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1)
    return np.where(lengths > 0, np.degrees(np.arctan2(across, along)), np.nan)


class _Mean:
    """Running mean; NaN and infinite values are left out."""

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
