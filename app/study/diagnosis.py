"""Diagnosis of recordings without flow and of large errors."""

from collections import Counter
from collections.abc import Iterable, Iterator

import numpy as np
from numpy.typing import NDArray

from app.analysis.evaluation import counting_pairs
from app.analysis.pair_estimator import PairEstimator
from app.analysis.pairs import Pair, prepare_pair
from app.study.ranges import span
from estimator import Label, Parameters, SceneFlow, truly_moves
from recordings import Recording

_WRONG = 0.5
"""Displacement error, as a share of the true displacement, above which an alignment is wrong."""


def diagnose_missing_flow(recording: Recording, parameters: Parameters) -> str | None:
    """Explain the missing flow of truly moving points, for the middle of the pairs that count.

    Returns:
        A sentence; None if no pair counts, or without truly moving points.
    """
    pairs = list(counting_pairs(recording, parameters.n))
    if not pairs:
        return None
    source_k, target_k = pairs[len(pairs) // 2]
    pair = next(_estimated(recording, parameters, [target_k]))
    if pair.truth is None or pair.truth.points is None or pair.flow is None:
        return None
    flow, moving = pair.flow, truly_moves(pair.truth.points)
    if not moving.any():
        return None
    cluster, count = Counter(flow.cluster[moving].tolist()).most_common(1)[0]
    reasons = {result.index: result.reason for result in flow.clusters}
    reason = reasons.get(cluster, "in no cluster.")
    return (
        f"Frames {source_k} and {target_k}, {count} of {int(moving.sum())} moving points: {reason}"
    )


def diagnose_wrong_alignment(recording: Recording, parameters: Parameters) -> str | None:
    """Report fitness and displacement of the moving clusters that ICP aligned wrongly.

    Returns:
        A sentence; None without such clusters, or without truth per point.
    """
    found = wrong = 0
    fitness: list[float] = []
    displacements: list[float] = []
    true_displacements: list[float] = []
    counting = [target_k for _, target_k in counting_pairs(recording, parameters.n)]
    for pair in _estimated(recording, parameters, counting):
        if pair.truth is None or pair.truth.points is None or pair.flow is None:
            continue
        off = list(_misaligned(pair.flow, pair.truth.points, pair.interval))
        found += bool(pair.flow.moving.any())
        wrong += bool(off)
        for result_fitness, displacement, true_displacement in off:
            fitness.append(result_fitness)
            displacements.append(displacement)
            true_displacements.append(true_displacement)
    if not wrong:
        return None
    return (
        f"In {wrong} of {found} pairs with a flow ICP aligns the moving cluster wrongly: fitness "
        f"{span(fitness, '.2f')}, mean displacement {span(displacements, '.2f')} m, where it went "
        f"{span(true_displacements, '.2f')} m."
    )


def _misaligned(
    flow: SceneFlow, points: NDArray[np.float64], interval: float
) -> Iterator[tuple[float, float, float]]:
    """(fitness, mean displacement m, true displacement m) of wrongly aligned moving clusters."""
    for result in flow.clusters:
        if result.label != Label.MOVING:
            continue
        true = points[result.remaining]
        moving = truly_moves(true)
        if moving.mean() <= 0.5:  # resting points labelled Moving are another error
            continue
        off, true_displacement = (
            float(np.linalg.norm(velocity[moving], axis=1).mean()) * interval
            for velocity in (result.velocity - true, true)
        )
        if off > _WRONG * true_displacement:
            yield result.fitness, result.mean_displacement, true_displacement


def _estimated(
    recording: Recording, parameters: Parameters, frames: Iterable[int]
) -> Iterator[Pair]:
    estimator = PairEstimator(parameters)
    for k in frames:
        yield estimator.pair(k, lambda k: prepare_pair(recording, k, parameters))
