"""Pairs and their flow: computed once, remembered, and shared between sessions."""

import time
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from app.analysis.cache import Memory
from app.analysis.evaluation import pair_errors
from app.analysis.foreground import Foreground
from app.analysis.library import Opened
from app.analysis.timeline import Outline
from estimator import (
    MOVING_SPEED,
    CloudPair,
    Label,
    Metrics,
    Parameters,
    SceneFlow,
    cloud_pair,
    estimate_pair,
)
from recordings import Cloud, PairTruth
from robot_assets import Transform


@dataclass(frozen=True)
class Pair:
    """The pair of a frame, and what was estimated from it.

    Attributes:
        frame: k.
        target: P_k.
        source: P_{k-n}, None where frame k-n is before the start.
        interval: seconds between the two stamps, NaN without a source.
        link_poses: {link: T_fixed_link (4, 4)} at frame k.
        truth: over the interval, None where it is not known.
        flow: None without a source, or where nothing was estimated yet.
        milliseconds: how long the estimate took, NaN without one.
    """

    frame: int
    target: Cloud
    source: Cloud | None
    interval: float
    link_poses: dict[str, Transform]
    truth: PairTruth | None
    flow: SceneFlow | None = field(default=None)
    milliseconds: float = field(default=float("nan"))

    @property
    def object_velocity(self) -> NDArray[np.float64] | None:
        """Velocity (3,) m/s of the moving object, mean over its points; None unless it moves."""
        if self.truth is None or len(self.truth.velocity) == 0:
            return None
        velocity = np.asarray(self.truth.velocity[self.truly_moving]).mean(axis=0)
        return velocity if np.linalg.norm(velocity) > MOVING_SPEED else None

    @property
    def truly_moving(self) -> NDArray[np.bool_]:
        """(N,) whether a source point truly moves; all of them where only the object is known."""
        size = len(self.source.points) if self.source else 0
        if self.truth is None or self.truth.points is None:
            return np.ones(size, dtype=bool)
        moving = np.linalg.norm(self.truth.points, axis=1) > MOVING_SPEED
        return moving if moving.any() else np.ones(size, dtype=bool)

    @property
    def anything_moves(self) -> bool:
        """Whether the estimate found something that moves."""
        return self.flow is not None and bool((self.flow.label == Label.MOVING).any())

    @property
    def errors(self) -> Metrics | None:
        """The errors of this pair; None unless it has a flow and its object moves."""
        if self.flow is None or self.truth is None or self.object_velocity is None:
            return None
        return pair_errors(self.flow, self.interval, self.truth).metrics()


def warm_up() -> None:
    """Load what the first estimate needs, so that it need not wait for it."""
    steps = np.linspace(0.0, 0.1, 6)
    patch = np.stack(np.meshgrid(steps, steps, [0.0]), axis=-1).reshape(-1, 3)
    cloud = np.vstack([patch, patch + 2.0])
    estimate_pair(cloud_pair(cloud, cloud, 1.0), Parameters())


@dataclass(frozen=True)
class _Prepared:
    """A pair before its estimate, and its clouds with what is known of them already."""

    pair: Pair
    clouds: CloudPair | None


class Estimates:
    """Clouds, pairs and flows, bounded in number, for all sessions.

    Args:
        clouds: how many clouds are remembered.
        pairs: of how many pairs it is remembered what does not depend on the thresholds.
        flows: how many estimates are remembered.

    Attributes:
        foreground: says when somebody waits for an estimate.
    """

    def __init__(self, clouds: int = 400, pairs: int = 200, flows: int = 400) -> None:
        self._clouds: Memory[tuple, Cloud] = Memory(clouds)
        self._prepared: Memory[tuple, _Prepared] = Memory(pairs)
        self._pairs: Memory[tuple, Pair] = Memory(flows)
        self._outlines: Memory[tuple, Outline] = Memory(16)
        self.foreground = Foreground()

    def pair(self, opened: Opened, k: int, parameters: Parameters) -> Pair:
        """The pair (k-n, k) without an estimate, its clouds taken from memory where they are.

        Raises:
            RecordingError: the file is broken there.
        """
        return self._prepare(opened, k, parameters).pair

    def estimated(self, opened: Opened, k: int, parameters: Parameters) -> Pair:
        """The pair (k-n, k) with its flow.

        Raises:
            RecordingError: the file is broken there.
        """

        def make() -> Pair:
            with self.foreground:
                return _estimate(self._prepare(opened, k, parameters), parameters)

        return self._pairs.get((opened.key, k, parameters), make)

    def estimated_ahead(self, opened: Opened, k: int, parameters: Parameters) -> Pair:
        """The same where nobody waits for it: it is not counted as work in the foreground."""
        return self._pairs.get(
            (opened.key, k, parameters),
            lambda: _estimate(self._prepare(opened, k, parameters), parameters),
        )

    def known(self, opened: Opened, k: int, parameters: Parameters) -> Pair | None:
        """The pair (k-n, k) with its flow where it was estimated already."""
        return self._pairs.known((opened.key, k, parameters))

    def outline(self, opened: Opened) -> Outline:
        """What the recording says of its timeline by itself."""
        return self._outlines.get(opened.key, lambda: Outline(opened.recording))

    def remembered(self, opened: Opened, parameters: Parameters) -> list[Pair]:
        """All pairs of a recording that were estimated with these parameters, as far as known."""
        # A recording may have many more frames than are remembered.
        return [
            pair
            for (key, _, values), pair in self._pairs.items()
            if key == opened.key and values == parameters
        ]

    def _prepare(self, opened: Opened, k: int, parameters: Parameters) -> _Prepared:
        key = (opened.key, k, parameters.n, parameters.max_range)
        return self._prepared.get(key, lambda: self._make(opened, k, parameters))

    def _make(self, opened: Opened, k: int, parameters: Parameters) -> _Prepared:
        recording, source_k = opened.recording, k - parameters.n
        target = self._cloud(opened, k, parameters.max_range)
        if source_k < 0:
            pair = Pair(k, target, None, float("nan"), recording.link_poses(k), None)
            return _Prepared(pair, None)
        source = self._cloud(opened, source_k, parameters.max_range)
        interval = float(recording.stamps[k] - recording.stamps[source_k])
        pair = Pair(
            frame=k,
            target=target,
            source=source,
            interval=interval,
            link_poses=recording.link_poses(k),
            truth=recording.pair_truth(source_k, k, parameters.max_range),
        )
        return _Prepared(pair, cloud_pair(source, target, interval))

    def _cloud(self, opened: Opened, k: int, max_range: float) -> Cloud:
        key = (opened.key, k, max_range)
        return self._clouds.get(key, lambda: opened.recording.cloud(k, max_range))


def _estimate(prepared: _Prepared, parameters: Parameters) -> Pair:
    if prepared.clouds is None:
        return prepared.pair
    start = time.perf_counter()
    flow = estimate_pair(prepared.clouds, parameters)
    milliseconds = 1e3 * (time.perf_counter() - start)
    return replace(prepared.pair, flow=flow, milliseconds=milliseconds)
