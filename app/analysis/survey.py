"""Counts, speeds and errors of every frame of a recording."""

from itertools import islice

import numpy as np
from numpy.typing import NDArray

from app.analysis.evaluation import counting_pairs
from app.analysis.pairs import Pair
from estimator import METRIC_INFO, Label, Metrics, Parameters, PooledErrors, SceneFlow
from recordings import Cloud, Recording

_SUMS = len(PooledErrors().sums)


class Survey:
    """Counts, speeds and errors of every frame, with one set of parameters.

    Filled by one thread, in any order, while other threads may read it.

    Attributes:
        parameters: of the estimates.
        done: (K,) whether a frame was computed.
        counts: (K,) whether a frame's pair counts in the means: the object moves at both frames.
        points: (K,) source points.
        moving: (K,) those with a flow.
        stationary: (K,) those labelled Stationary.
        unassigned: (K,) those labelled Unassigned.
        clusters: (K,) number of clusters.
        interval: (K,) s, between the two stamps.
        empty: (K,) whether a frame is known to have no points.
        valid: (K,) share of the zones that have a range.
        speed: (K,) m/s, mean over the points with a flow.
        true_speed: (K,) m/s of the moving object over the pair, 0 where it rests.
        metrics: {name as in `METRIC_INFO`: (K,) its values of each pair alone, which are defined
            while the object moves, at pairs that do not count, too}.

    Values are NaN where not yet computed or undefined.
    """

    def __init__(self, recording: Recording, parameters: Parameters) -> None:
        size = len(recording)
        self.parameters = parameters
        self.done = np.arange(size) < parameters.n  # they have no pair
        self.empty = np.zeros(size, dtype=bool)
        self._sums = np.zeros((size, _SUMS))
        self.counts = np.zeros(size, dtype=bool)
        for _, k in counting_pairs(recording, parameters.n):
            self.counts[k] = True
        self.points, self.moving, self.stationary, self.unassigned, self.clusters = (
            np.full(size, np.nan) for _ in range(5)
        )
        self.valid, self.interval, self.speed, self.true_speed = (
            np.full(size, np.nan) for _ in range(4)
        )
        self.metrics: dict[str, NDArray[np.float64]] = {
            name: np.full(size, np.nan)
            for name, info in METRIC_INFO.items()
            if info.plotted or info.kind != "count"
        }
        self._order = coarse_to_fine(size)
        self._at = 0

    def __len__(self) -> int:
        return len(self.done)

    @property
    def complete(self) -> bool:
        """Whether every frame was computed."""
        return bool(self.done.all())

    @property
    def pairs(self) -> int:
        """Number of pairs of the recording."""
        return max(len(self) - self.parameters.n, 0)

    def missing(self, most: int) -> list[int]:
        """Next frames to compute, at most so many; none once all are done."""
        while self._at < len(self._order) and self.done[self._order[self._at]]:
            self._at += 1
        left = (k for k in islice(self._order, self._at, None) if not self.done[k])
        return list(islice(left, most))

    def put(self, k: int, pair: Pair | None) -> None:
        """Store the numbers of frame `k` from its pair, None for a broken frame."""
        if pair is not None and pair.source is not None:
            self.empty[k] = len(pair.target.points) == 0
            self.empty[k - self.parameters.n] = len(pair.source.points) == 0
            self.valid[k], self.valid[k - self.parameters.n] = map(
                valid_share, (pair.target, pair.source)
            )
        if pair is not None and pair.flow is not None:
            self._put_flow(k, pair, pair.flow)
        self.done[k] = True

    def summary(self) -> Metrics:
        """Errors pooled over the pairs, as by `evaluate`."""
        errors = PooledErrors()
        # One after the other, as `evaluate` adds them, so that sums agree to the last bit.
        errors.include(np.cumsum(self._sums, axis=0)[-1])
        return errors.metrics()

    def _put_flow(self, k: int, pair: Pair, flow: SceneFlow) -> None:
        moving = flow.moving
        self.interval[k] = pair.interval
        self.points[k], self.clusters[k] = len(flow.label), len(flow.clusters)
        self.moving[k] = np.count_nonzero(moving)
        self.stationary[k] = np.count_nonzero(flow.label == Label.STATIONARY)
        self.unassigned[k] = np.count_nonzero(flow.label == Label.UNASSIGNED)
        if moving.any():
            self.speed[k] = np.linalg.norm(flow.velocity[moving], axis=1).mean()
        pooled = pair.pooled_errors(counts=bool(self.counts[k]))
        if pooled is None:
            return
        velocity = pair.object_velocity
        self.true_speed[k] = 0.0 if velocity is None else np.linalg.norm(velocity)
        self._sums[k] = pooled.sums
        metrics = pair.errors or pooled.metrics()
        for name, values in self.metrics.items():
            values[k] = getattr(metrics, name)


def valid_share(cloud: Cloud) -> float:
    """Share of a cloud's zones that have a range, NaN without zones."""
    zones = np.count_nonzero(np.isfinite(cloud.directions[..., 0]))
    return np.count_nonzero(np.isfinite(cloud.ranges)) / zones if zones else np.nan


def coarse_to_fine(size: int) -> list[int]:
    """Permutation of `range(size)`, every 16th first, so that a plot shows its shape early."""
    return sorted(range(size), key=lambda k: (-min(k & -k, 16) if k else -16, k))
