"""Pairs of a recording: the two clouds, the frames between, the interval and the truth.

Everything that estimates on a recording takes its pairs from here.
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
    Window,
)
from recordings import Cloud, PairTruth, Recording
from robot_assets import Transform


@dataclass(frozen=True)
class Pair:
    """The pair (k-n, k) of a frame, and its flow where that was estimated.

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
        if self.object_velocity is None or (pooled := self.pooled_errors()) is None:
            return None
        return pooled.metrics()

    def pooled_errors(self, *, counts: bool = True) -> PooledErrors | None:
        """The errors of this pair, to be pooled with others; None without a flow or truth.

        Args:
            counts: whether the object moves at both frames; else there is the false flow alone.
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
    """A pair before its estimate, and the window of frames that a method looks at.

    Attributes:
        pair: without a flow.
        window: None where the pair has no source. It remembers the stages of its estimates.
    """

    pair: Pair
    window: Window | None


def prepare_pair(
    recording: Recording,
    k: int,
    parameters: Parameters,
    cloud: Callable[[int], Cloud] | None = None,
) -> PreparedPair:
    """Put the pair (k-n, k) of a recording together, without an estimate.

    Args:
        recording: what is estimated.
        k: the target's frame.
        parameters: of which `n` and `max_range` decide.
        cloud: gives the cloud of a frame at `max_range` where clouds are kept, else None.

    Raises:
        RecordingError: the file is broken there. Frames between are read when a method asks for
            them, and may raise it then.
    """
    source_k, max_range = k - parameters.n, parameters.max_range
    load = cloud or (lambda frame: recording.cloud(frame, max_range))
    target, link_poses = load(k), recording.link_poses(k)
    if source_k < 0:
        return PreparedPair(Pair(k, target, None, float("nan"), link_poses, None), None)
    source, n = load(source_k), parameters.n
    frames = LazyFrames(n + 1, lambda index: load(source_k + index), {0: source, n: target})
    window = Window(frames, recording.stamps[source_k : k + 1])
    truth = recording.pair_truth(source_k, k, max_range)
    pair = Pair(k, target, source, window.interval, link_poses, truth)
    return PreparedPair(pair, window)
