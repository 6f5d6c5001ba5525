"""Counts, speeds and errors of every frame of a recording."""

import numpy as np
from numpy.typing import NDArray

from app.analysis.pairs import Pair
from estimator import METRIC_INFO, Label, Metrics, Parameters, PooledErrors, SceneFlow
from estimator.metrics import flow_sums, means_of, only_false_flow
from estimator.point_errors import ERRORS, lengths
from recordings import Cloud, Recording

_OF_PAIRS = ("counts", "_moves", "points", "clusters", "interval", "true_speed")
_OF_FRAMES = ("empty", "valid")


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
        self._sums = np.zeros((size, len(PooledErrors().sums)))
        self.counts = np.zeros(size, dtype=bool)
        self._moves = np.zeros(size, dtype=bool)
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

    def put(self, k: int, pair: Pair | None) -> None:
        """Store the numbers of frame `k` from its pair, None for a broken frame."""
        if pair is not None and pair.source is not None:
            self.empty[k] = len(pair.target.points) == 0
            self.empty[k - self.parameters.n] = len(pair.source.points) == 0
            self.valid[k], self.valid[k - self.parameters.n] = map(
                valid_share, (pair.target, pair.source)
            )
        if pair is not None and pair.flow is not None:
            self._put_facts(k, pair, pair.flow)
            errors = pair.pooled_errors()
            self.put_flows(
                np.array([k]),
                np.array([_count(pair.flow, Label.MOVING)]),
                np.array([_count(pair.flow, Label.STATIONARY)]),
                np.array([mean_speed(pair.flow)]),
                None if errors is None else errors.sums[None, 1:],
            )
        self.done[k] = True

    def put_flows(
        self,
        frames: NDArray[np.intp],
        moving: NDArray[np.int64],
        stationary: NDArray[np.int64],
        speed: NDArray[np.float64],
        sums: NDArray[np.float64] | None,
    ) -> None:
        """Store what depends on the flow of some frames' pairs, of which all else is stored.

        Args:
            frames: (F,).
            moving: (F,) points.
            stationary: (F,) points.
            speed: (F,) m/s.
            sums: (F, 2 len(ERRORS)) of the errors of all points, None without truth.
        """
        self.moving[frames], self.stationary[frames] = moving, stationary
        self.unassigned[frames] = self.points[frames] - moving - stationary
        self.speed[frames] = speed
        if sums is not None:
            counts, resting = self.counts[frames, None], only_false_flow(sums)
            self._sums[frames] = np.hstack([counts, np.where(counts, sums, resting)])
            moves = counts | self._moves[frames, None]
            means = means_of(np.where(moves, sums, resting))
            for name, values in self.metrics.items():
                values[frames] = means[:, ERRORS.index(name)]
        self.done[frames] = True

    def copy_facts(self, other: "Survey", frames: NDArray[np.intp]) -> None:
        """Copy what does not depend on the flow of some frames' pairs."""
        for name in _OF_PAIRS:
            getattr(self, name)[frames] = getattr(other, name)[frames]
        for name in _OF_FRAMES:
            for at in (frames, frames - self.parameters.n):
                getattr(self, name)[at] = getattr(other, name)[at]

    def summary(self) -> Metrics:
        """Errors pooled over the pairs, as by `evaluate`."""
        errors = PooledErrors()
        # One after the other, as `evaluate` adds them, so that sums agree to the last bit.
        errors.include(np.cumsum(self._sums, axis=0)[-1])
        return errors.metrics()

    def _put_facts(self, k: int, pair: Pair, flow: SceneFlow) -> None:
        self.interval[k] = pair.interval
        self.points[k], self.clusters[k] = len(flow.label), len(flow.clusters)
        self.counts[k] = pair.counts
        if pair.truth is not None:
            velocity = pair.object_velocity
            self._moves[k] = velocity is not None
            self.true_speed[k] = 0.0 if velocity is None else np.linalg.norm(velocity)


def _count(flow: SceneFlow, label: Label) -> int:
    return int(np.count_nonzero(flow.label == label))


def mean_speed(flow: SceneFlow) -> float:
    """Mean speed of the points with a flow in m/s, NaN without any."""
    speeds = lengths(flow.velocity)[:, None]
    return float(means_of(flow_sums(flow, speeds))[0])


def valid_share(cloud: Cloud) -> float:
    """Share of a cloud's zones that have a range, NaN without zones."""
    zones = np.count_nonzero(np.isfinite(cloud.directions[..., 0]))
    return np.count_nonzero(np.isfinite(cloud.ranges)) / zones if zones else np.nan
