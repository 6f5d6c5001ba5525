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
import re
from dataclasses import dataclass, field, fields
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from estimator.flow import SceneFlow

MOVING_SPEED = 0.01
"""Speed in m/s above which the truth counts as motion."""

STRICT, RELAXED, OUTLYING = 0.05, 0.10, 0.30
"""AccS: e below STRICT metres or r below STRICT; AccR likewise with RELAXED; an outlier: e above
OUTLYING metres or r above RELAXED."""

RELATIVE_EPSILON = 1e-4
"""Metres in the denominator of r, as in HPLFlowNet (Argoverse 2 has 1e-10, ICP-Flow 1e-20)."""


MetricKind = Literal["count", "share", "error", "signed"]
"""A whole number; a fraction from 0 to 1; a number not below 0; a number of either sign."""


@dataclass(frozen=True)
class MetricInfo:
    """Description of a metric, from which tables, files, plots and the page are made.

    Attributes:
        title: its name.
        short: abbreviated name.
        unit: "" for a plain number.
        form: format of its values.
        kind: range of its values.
        definition: in words.
        source: publication that defines it.
        plotted: whether the page plots it for every pair.
    """

    title: str
    short: str
    unit: str
    form: str
    kind: MetricKind
    definition: str
    source: str
    plotted: bool = False

    @property
    def heading(self) -> str:
        """Its title with its unit."""
        return f"{self.title} {self.unit}".strip()

    @property
    def spec(self) -> str:
        """Format specification of its values, with a sign where it is signed."""
        return f"+{self.form}" if self.kind == "signed" else self.form

    def text(self, value: float | None) -> str:
        """Format a value, – where it is undefined."""
        return "–" if value is None or math.isnan(value) else format(value, self.spec)


def _metric(
    title: str,
    definition: str,
    source: str = "",
    *,
    kind: MetricKind = "share",
    short: str = "",
    unit: str = "",
    form: str = ".3f",
    plotted: bool = False,
) -> Any:  # noqa: ANN401 (a dataclass field)
    if not re.fullmatch(r"d|\.\d+f", form):
        raise ValueError(f"{title}: a format is written d or .3f, and not {form!r}.")
    info = MetricInfo(title, short or title, unit, form, kind, definition, source, plotted)
    return field(metadata={"metric": info})


@dataclass(frozen=True)
class Metrics:
    """Errors pooled over all points and pairs; NaN where undefined.

    A pair counts where the object moves at both its frames. Values are means over all points of
    all pairs that count, not means of the pairs' means; only `false_flow` includes the other pairs.
    A point whose own truth is unknown enters only the paper's errors. `METRIC_INFO` defines each.
    """

    pairs: int = _metric(
        "pairs", "pairs that count, those without any flow included", kind="count", form="d"
    )
    points_with_flow: int = _metric(
        "points with flow", "source points with a flow in all of them", kind="count", form="d"
    )
    angle_deg: float = _metric(
        "angle deviation",
        "mean angle between each flow and the moving object's velocity; a flow of exactly zero "
        "has no direction and is left out",
        "paper, section IV",
        kind="error",
        unit="deg",
        form=".2f",
        plotted=True,
    )
    velocity_error: float = _metric(
        "velocity error",
        "mean length of the difference between each flow and the moving object's velocity",
        "paper, section IV",
        kind="error",
        short="vel. error",
        unit="m/s",
        form=".4f",
        plotted=True,
    )
    coverage: float = _metric(
        "coverage", "truly moving points that got a flow / truly moving points", plotted=True
    )
    precision: float = _metric(
        "precision", "points with a flow that truly move / points with a flow", plotted=True
    )
    epe3d: float = _metric(
        "EPE3D",
        "end-point error, mean e per pair",
        "FlowNet3D (Liu et al., CVPR 2019)",
        kind="error",
        unit="m",
        form=".4f",
    )
    acc_s: float = _metric(
        "AccS",
        "strict accuracy: share of points with e < 0.05 m or r < 0.05",
        "HPLFlowNet (Gu et al., CVPR 2019), evaluation_utils.evaluate_3d; the same in Argoverse 2 "
        "and ICP-Flow",
    )
    acc_r: float = _metric(
        "AccR",
        "relaxed accuracy: share of points with e < 0.10 m or r < 0.10",
        "HPLFlowNet, as AccS",
    )
    outliers: float = _metric(
        "outliers",
        "share of points with e > 0.30 m or r > 0.10",
        "HPLFlowNet; ICP-Flow's ROutliers is another: it requires both, with r > 0.30",
    )
    dynamic_iou: float = _metric(
        "dynamic IoU",
        "points that truly move and got a flow / points that truly move or got a flow, "
        "TP / (TP + FP + FN). Truly moving is faster than MOVING_SPEED, as for coverage and "
        "precision, so that sets of parameters can be compared; found to move is the method's own "
        "decision, in the paper's the displacement gate delta",
        "evaluation of Argoverse 2, which calls moving what goes 0.05 m per 0.1 s",
    )
    false_flow: float = _metric(
        "false flow",
        "points with a flow that do not truly move / points that do not truly move, over all "
        "pairs whose truth is known, those that do not count included",
        form=".4f",
    )


METRIC_INFO: dict[str, MetricInfo] = {f.name: f.metadata["metric"] for f in fields(Metrics)}

_MEANS = tuple(name for name, info in METRIC_INFO.items() if info.kind != "count")


class PooledErrors:
    """Accumulator of errors, pair by pair."""

    def __init__(self) -> None:
        self._pairs = 0
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
        self._pairs += 1
        moving = flow.moving
        estimated, true = flow.velocity[moving], object_velocity[moving]
        self._add("angle_deg", angles_deg(estimated, true))
        self._add("velocity_error", np.linalg.norm(estimated - true, axis=1))
        if point_velocity is None:
            return
        known = _known(point_velocity)
        found, truly = moving[known], _moves(point_velocity[known])
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
        self._add("false_flow", flow.moving[known][~_moves(point_velocity[known])])

    @property
    def sums(self) -> NDArray[np.float64]:
        """Array for `include`: number of pairs, then sum and count of each mean."""
        means = self._means.values()
        return np.array([self._pairs, *(v for m in means for v in (m.sum, m.count))])

    def include(self, sums: NDArray[np.float64]) -> None:
        """Add the pairs of another accumulator, given its `sums`."""
        self._pairs += int(sums[0])
        for mean, (total, count) in zip(self._means.values(), sums[1:].reshape(-1, 2), strict=True):
            mean.sum += float(total)
            mean.count += int(count)

    def metrics(self) -> Metrics:
        """The errors of all pairs added so far."""
        return Metrics(
            pairs=self._pairs,
            points_with_flow=self._means["velocity_error"].count,
            **{name: mean.value for name, mean in self._means.items()},
        )

    def _add(self, name: str, values: NDArray[np.float64] | NDArray[np.bool_]) -> None:
        self._means[name].add(values)


def _known(point_velocity: NDArray[np.float64]) -> NDArray[np.bool_]:
    return np.asarray(np.isfinite(point_velocity).all(axis=1))


def _moves(velocity: NDArray[np.float64]) -> NDArray[np.bool_]:
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
