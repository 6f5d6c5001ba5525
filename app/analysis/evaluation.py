"""A method run over a whole recording, against its truth."""

import math
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from estimator import (
    MOVING_SPEED,
    Metrics,
    Parameters,
    PooledErrors,
    SceneFlow,
    estimate_scene_flow,
)
from recordings import PairTruth, Recording, RecordingError

COLUMNS = {
    "pairs": ("pairs", "d"),
    "points_with_flow": ("points with flow", "d"),
    "angle_deg": ("angle deg", ".2f"),
    "velocity_error": ("velocity error m/s", ".4f"),
    "coverage": ("coverage", ".3f"),
    "precision": ("precision", ".3f"),
    "epe3d": ("EPE3D m", ".4f"),
    "acc_s": ("AccS", ".3f"),
    "acc_r": ("AccR", ".3f"),
    "outliers": ("outliers", ".3f"),
    "dynamic_iou": ("dynamic IoU", ".3f"),
    "false_flow": ("false flow", ".4f"),
}
"""{attribute of Metrics: (what people read, format)}."""


def evaluate(
    recording: Recording, parameters: Parameters, *, with_resting: bool = True
) -> Metrics | None:
    """Estimate every pair whose truth is known and pool the errors; None where there is no truth.

    Pairs that do not count are left out where the file is broken at them.

    Args:
        recording: what is estimated.
        parameters: of the estimates.
        with_resting: whether pairs that do not count are estimated, too. Only `false_flow` needs
            them, and is NaN without; where the object rests for long, the rest is there sooner.

    Raises:
        RecordingError: the file is broken at a pair that counts.
    """
    if not recording.has_truth:
        return None
    errors = PooledErrors()
    counting = set(counting_pairs(recording, parameters.n))
    for pair in zip(range(len(recording)), range(parameters.n, len(recording)), strict=False):
        if pair in counting:
            errors.include(_sums(recording, *pair, parameters, counts=True))
        elif with_resting:
            # A frame that is broken while nothing moves does not cost the errors.
            with suppress(RecordingError):
                errors.include(_sums(recording, *pair, parameters, counts=False))
    metrics = errors.metrics()
    return metrics if with_resting else replace(metrics, false_flow=math.nan)


def _sums(
    recording: Recording, source_k: int, target_k: int, parameters: Parameters, *, counts: bool
) -> NDArray[np.float64]:
    truth = recording.pair_truth(source_k, target_k, parameters.max_range)
    if truth is None or not (counts or truth.points is not None):
        return PooledErrors().sums
    interval = float(recording.stamps[target_k] - recording.stamps[source_k])
    flow = estimate_scene_flow(
        recording.cloud(source_k, parameters.max_range),
        recording.cloud(target_k, parameters.max_range),
        interval,
        parameters,
    )
    return pair_errors(flow, interval, truth, counts=counts).sums


def pair_errors(
    flow: SceneFlow, interval: float, truth: PairTruth, *, counts: bool = True
) -> PooledErrors:
    """The errors of one pair, whose stamps are `interval` seconds apart.

    Of a pair that does not count there is the false flow alone.
    """
    errors = PooledErrors()
    if counts:
        errors.add(flow, interval, truth.velocity, truth.points)
    elif truth.points is not None:
        errors.add_resting(flow, truth.points)
    return errors


def counting_pairs(recording: Recording, n: int) -> Iterator[tuple[int, int]]:
    """The pairs (k-n, k) at both of whose frames the object moves."""
    moving = [moves(recording, k) for k in range(len(recording))]
    for k in range(n, len(recording)):
        if moving[k - n] and moving[k]:
            yield k - n, k


def moves(recording: Recording, k: int) -> bool:
    """Whether the truth says that the object moves at frame `k`."""
    velocity = recording.truth(k)
    return velocity is not None and float(np.linalg.norm(velocity)) > MOVING_SPEED
