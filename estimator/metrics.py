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
from estimator.point_errors import (
    ERRORS,
    MOVING_SPEED,
    OUTLYING,
    RELAXED,
    STRICT,
    point_errors,
    sums_of_groups,
)

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


class PooledErrors:
    """Accumulator of errors, pair by pair; within a pair, cluster by cluster."""

    def __init__(self) -> None:
        self._pairs = 0
        self._sums = np.zeros(2 * len(ERRORS))

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
        self._pairs += 1
        self._sums += flow_sums(
            flow,
            point_errors(flow.moving, flow.velocity, interval, object_velocity, point_velocity),
        )

    def add_resting(self, flow: SceneFlow, point_velocity: NDArray[np.float64]) -> None:
        """Add one pair that does not count; it changes only the false flow.

        Args:
            flow: of N source points.
            point_velocity: (N, 3) m/s of each point itself, NaN where unknown.
        """
        nothing = np.zeros_like(point_velocity)
        errors = point_errors(flow.moving, flow.velocity, 1.0, nothing, point_velocity)
        self._sums += only_false_flow(flow_sums(flow, errors))

    @property
    def sums(self) -> NDArray[np.float64]:
        """Array for `include`: the number of pairs, then sum and number of values of each mean."""
        return np.array([self._pairs, *self._sums])

    def include(self, sums: NDArray[np.float64]) -> None:
        """Add the pairs of another accumulator, given its `sums`."""
        self._pairs += int(sums[0])
        self._sums += sums[1:]

    def metrics(self) -> Metrics:
        """The errors of all pairs added so far."""
        # NaN is always this one, so that equal metrics compare as equal.
        values = [math.nan if math.isnan(mean) else mean for mean in means_of(self._sums).tolist()]
        means: dict[str, Any] = dict(zip(ERRORS, values, strict=True))
        with_flow = self._sums[2 * ERRORS.index("velocity_error") + 1]
        return Metrics(pairs=self._pairs, points_with_flow=int(with_flow), **means)


def flow_sums(flow: SceneFlow, values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Sum and number of the finite values of each column over all points of a flow.

    Points of a cluster without a flow are added first, then those with one, then those of the next
    cluster: in this order, what is known of each part of a cluster gives the same sum.

    Args:
        flow: of N source points.
        values: (N, M) of these points.

    Returns:
        (2 M,).
    """
    parts, group = np.unique(2 * flow.cluster + flow.moving, return_inverse=True)
    sums = sums_of_groups(values, group, len(parts))
    return np.cumsum(sums, axis=0)[-1] if len(sums) else np.zeros(2 * values.shape[1])


def only_false_flow(sums: NDArray[np.float64]) -> NDArray[np.float64]:
    """Sums (..., 2 len(ERRORS)) of which all but the false flow's are zero."""
    kept = np.zeros_like(sums)
    at = 2 * ERRORS.index("false_flow")
    kept[..., at : at + 2] = sums[..., at : at + 2]
    return kept


def means_of(sums: NDArray[np.float64]) -> NDArray[np.float64]:
    """Means (..., M) of sums and numbers (..., 2 M), NaN of no values."""
    with np.errstate(invalid="ignore"):
        return sums[..., ::2] / sums[..., 1::2]
