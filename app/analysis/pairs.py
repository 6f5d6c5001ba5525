"""Pairs of a recording: two clouds, the frames between, the interval and the truth.

Page, evaluation and study all take their pairs from here.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from estimator import (
    MOVING_SPEED,
    Label,
    LazyFrames,
    Metrics,
    Parameters,
    PooledErrors,
    SceneFlow,
    Stages,
    Window,
    truly_moves,
)
from recordings import Cloud, PairTruth, Recording
from robot_assets import Transform


@dataclass(frozen=True)
class Pair:
    """The pair (k-n, k) of frame k, with its flow once estimated.

    Attributes:
        frame: k.
        target: P_k.
        source: P_{k-n}, None where frame k-n is before the start.
        interval: seconds between the two stamps, NaN without a source.
        link_poses: {link: T_fixed_link (4, 4)} at frame k.
        truth: over the interval, None where unknown.
        flow: None without a source or before the estimate.
        milliseconds: duration of the estimate, NaN without one.
        reused: whether parts of the estimate had been computed before.
        n: frames between source and target, 0 without a source.
        object_poses: {frame of the recording's object meshes: T_fixed_object (4, 4)} at frame k.
        counts: whether it counts in the means: the object truly moves at both frames.
    """

    frame: int
    target: Cloud
    source: Cloud | None
    interval: float
    link_poses: dict[str, Transform]
    truth: PairTruth | None
    flow: SceneFlow | None = field(default=None)
    milliseconds: float = field(default=float("nan"))
    reused: bool = False
    n: int = 0
    object_poses: dict[str, Transform] = field(default_factory=dict[str, Transform])
    counts: bool = False

    @property
    def object_velocity(self) -> NDArray[np.float64] | None:
        """Velocity (3,) m/s of the moving object, mean over its points; None unless it moves."""
        if self.truth is None or len(self.truth.velocity) == 0:
            return None
        velocity = np.asarray(self.truth.velocity[self.truly_moving]).mean(axis=0)
        return velocity if np.linalg.norm(velocity) > MOVING_SPEED else None

    @property
    def truly_moving(self) -> NDArray[np.bool_]:
        """Mask (N,) of truly moving source points; all True if none is known to move."""
        size = len(self.source.points) if self.source else 0
        if self.truth is None or self.truth.points is None:
            return np.ones(size, dtype=bool)
        moving = truly_moves(self.truth.points)
        return moving if moving.any() else np.ones(size, dtype=bool)

    @property
    def anything_moves(self) -> bool:
        """Whether any source point is labelled Moving."""
        return self.flow is not None and bool((self.flow.label == Label.MOVING).any())

    @property
    def errors(self) -> Metrics | None:
        """Errors of this pair; None unless it has a flow and its object moves."""
        if self.object_velocity is None or (pooled := self.pooled_errors()) is None:
            return None
        return pooled.metrics()

    def pooled_errors(self, *, counts: bool = True) -> PooledErrors | None:
        """Errors of this pair, for pooling with others; None without flow or truth.

        Args:
            counts: whether the object moves at both frames; otherwise only false flow is pooled.
        """
        if self.flow is None or self.truth is None:
            return None
        pooled = PooledErrors()
        if counts:
            pooled.add(self.flow, self.interval, self.truth.velocity, self.truth.points)
        elif self.truth.points is not None:
            pooled.add_resting(self.flow, self.truth.points)
        return pooled


@dataclass(frozen=True)
class PreparedPair:
    """A pair before its estimate, and the window that a method takes.

    Attributes:
        pair: without a flow.
        window: None without a source. It caches the stages of its estimates.
    """

    pair: Pair
    window: Window | None


LoadCloud = Callable[[int], Cloud]
"""Function from a frame to its cloud."""


def prepare_pair(recording: Recording, k: int, parameters: Parameters) -> PreparedPair:
    """Load the pair (k-n, k) of a recording, without an estimate.

    Args:
        recording: to read.
        k: the target's frame.
        parameters: of which `n` and `max_range` are used.

    Raises:
        RecordingError: the file is broken there. Frames between are read lazily, and may raise
            it when a method reads them.
    """

    def load(frame: int) -> Cloud:
        return recording.cloud(frame, parameters.max_range)

    pair = make_pair(recording, k, parameters, load)
    return PreparedPair(pair, window_of(pair, recording, load, Stages()))


def make_pair(recording: Recording, k: int, parameters: Parameters, load: LoadCloud) -> Pair:
    """Load the pair (k-n, k) through `load`; otherwise as `prepare_pair`."""
    source_k = k - parameters.n
    target, link_poses = load(k), recording.link_poses(k)
    object_poses = recording.object_poses(k)
    if source_k < 0:
        return Pair(k, target, None, float("nan"), link_poses, None, object_poses=object_poses)
    return Pair(
        frame=k,
        target=target,
        source=load(source_k),
        interval=float(recording.stamps[k] - recording.stamps[source_k]),
        link_poses=link_poses,
        truth=recording.pair_truth(source_k, k, parameters.max_range),
        n=parameters.n,
        object_poses=object_poses,
        counts=counts(recording, source_k, k),
    )


def moves(recording: Recording, k: int) -> bool:
    """Whether the object truly moves at frame `k`."""
    velocity = recording.truth(k)
    return velocity is not None and float(np.linalg.norm(velocity)) > MOVING_SPEED


def counts(recording: Recording, source_k: int, k: int) -> bool:
    """Whether a pair counts in the means: the object truly moves at both frames."""
    return moves(recording, k) and moves(recording, source_k)


def window_of(pair: Pair, recording: Recording, load: LoadCloud, stages: Stages) -> Window | None:
    """Window from a pair's source to its target, None without a source.

    Args:
        pair: of the recording.
        recording: of the stamps.
        load: reads the frames between, lazily.
        stages: cached results of the pair's earlier estimates.
    """
    if pair.source is None:
        return None
    first = pair.frame - pair.n
    frames = LazyFrames(
        pair.n + 1, lambda index: load(first + index), {0: pair.source, pair.n: pair.target}
    )
    return Window(frames, recording.stamps[first : pair.frame + 1], stages)
