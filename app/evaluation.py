"""A method run over a whole recording, against its truth."""

from collections.abc import Iterator

import numpy as np

from estimator import (
    MOVING_SPEED,
    Metrics,
    Parameters,
    PooledErrors,
    SceneFlow,
    estimate_scene_flow,
)
from recordings import PairTruth, Recording

COLUMNS = {
    "pairs": ("pairs", "d"),
    "points_with_flow": ("points with flow", "d"),
    "angle_deg": ("angle deg", ".2f"),
    "velocity_error": ("velocity error m/s", ".4f"),
    "coverage": ("coverage", ".3f"),
    "precision": ("precision", ".3f"),
    "epe3d": ("EPE3D m", ".4f"),
}
"""{attribute of Metrics: (what people read, format)}."""


def evaluate(recording: Recording, parameters: Parameters) -> Metrics | None:
    """Estimate every pair that counts and pool the errors; None where there is no truth."""
    if not recording.has_truth:
        return None
    errors = PooledErrors()
    for source_k, target_k in counting_pairs(recording, parameters.n):
        truth = recording.pair_truth(source_k, target_k, parameters.max_range)
        if truth is None:
            continue
        interval = float(recording.stamps[target_k] - recording.stamps[source_k])
        flow = estimate_scene_flow(
            recording.cloud(source_k, parameters.max_range),
            recording.cloud(target_k, parameters.max_range),
            interval,
            parameters,
        )
        errors.include(pair_errors(flow, interval, truth).sums)
    return errors.metrics()


def pair_errors(flow: SceneFlow, interval: float, truth: PairTruth) -> PooledErrors:
    """The errors of one pair, whose stamps are `interval` seconds apart."""
    errors = PooledErrors()
    errors.add(flow, interval, truth.velocity, truth.points)
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
