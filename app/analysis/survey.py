"""Moving points, speed and errors of every frame of a recording."""

import numpy as np
from numpy.typing import NDArray

from app.analysis.evaluation import counting_pairs
from app.analysis.pairs import Pair
from estimator import METRIC_INFO, Metrics, Parameters, PooledErrors
from recordings import Recording

_SUMS = len(PooledErrors().sums)


class Survey:
    """Moving points, speeds and errors of every frame, with one set of parameters.

    Filled by one thread, in any order, while other threads may read it.

    Attributes:
        parameters: of the estimates.
        done: (K,) whether a frame was computed.
        moving: (K,) points with a flow.
        empty: (K,) whether a frame is known to have no points.
        speed: (K,) m/s, mean over the points with a flow.
        true_speed: (K,) m/s of the moving object over the pair, 0 where it rests.
        metrics: {name as in `METRIC_INFO`: (K,) its values, at pairs that count}.

    Values are NaN where not yet computed or undefined.
    """

    def __init__(self, recording: Recording, parameters: Parameters) -> None:
        size = len(recording)
        self.parameters = parameters
        self.done = np.arange(size) < parameters.n  # they have no pair
        self.empty = np.zeros(size, dtype=bool)
        self._sums = np.zeros((size, _SUMS))
        self._counts = np.zeros(size, dtype=bool)
        for _, k in counting_pairs(recording, parameters.n):
            self._counts[k] = True
        self.moving, self.speed, self.true_speed = (np.full(size, np.nan) for _ in range(3))
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

    def missing(self) -> int | None:
        """Next frame to compute, None once all are done."""
        while self._at < len(self._order) and self.done[self._order[self._at]]:
            self._at += 1
        return self._order[self._at] if self._at < len(self._order) else None

    def put(self, k: int, pair: Pair | None) -> None:
        """Store the numbers of frame `k` from its pair, None for a broken frame."""
        if pair is not None and pair.source is not None:
            self.empty[k] = len(pair.target.points) == 0
            self.empty[k - self.parameters.n] = len(pair.source.points) == 0
        if pair is not None and pair.flow is not None:
            moving = pair.flow.moving
            self.moving[k] = np.count_nonzero(moving)
            if moving.any():
                self.speed[k] = np.linalg.norm(pair.flow.velocity[moving], axis=1).mean()
            if pair.truth is not None:
                velocity = pair.object_velocity
                self.true_speed[k] = 0.0 if velocity is None else np.linalg.norm(velocity)
                errors = pair.pooled_errors(counts=bool(self._counts[k]))
                assert errors is not None
                self._put_errors(k, errors)
        self.done[k] = True

    def summary(self) -> Metrics:
        """Errors pooled over the pairs, as by `evaluate`."""
        errors = PooledErrors()
        for sums in self._sums:
            errors.include(sums)
        return errors.metrics()

    def _put_errors(self, k: int, errors: PooledErrors) -> None:
        self._sums[k] = errors.sums
        metrics = errors.metrics()
        for name, values in self.metrics.items():
            values[k] = getattr(metrics, name)


def coarse_to_fine(size: int) -> list[int]:
    """Permutation of `range(size)`, every 16th first, so that a plot shows its shape early."""
    return sorted(range(size), key=lambda k: (-min(k & -k, 16) if k else -16, k))
