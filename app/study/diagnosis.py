"""Why nothing got a flow, and what went wrong where errors are large."""

from collections import Counter
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from app.analysis.evaluation import counting_pairs
from app.study.words import span
from estimator import MOVING_SPEED, Label, Parameters, SceneFlow, estimate_scene_flow
from recordings import Recording

_WRONG = 0.5
"""Share of their true way that a cluster's points are off by where its alignment is wrong."""


def why_no_flow(recording: Recording, parameters: Parameters) -> str | None:
    """What became of the points that truly move, in the middle one of the pairs that count.

    None where no pair counts, or the truth of points is not known, or none of them moves.
    """
    pairs = list(counting_pairs(recording, parameters.n))
    if not pairs:
        return None
    source_k, target_k = pairs[len(pairs) // 2]
    truth = recording.pair_truth(source_k, target_k, parameters.max_range)
    if truth is None or truth.points is None:
        return None
    flow = _flow(recording, source_k, target_k, parameters)
    moving = np.linalg.norm(truth.points, axis=1) > MOVING_SPEED
    if not moving.any():
        return None
    cluster, count = Counter(flow.cluster[moving].tolist()).most_common(1)[0]
    reason = "in no cluster." if cluster < 0 else flow.clusters[cluster].reason
    return (
        f"Frames {source_k} and {target_k}, {count} of {int(moving.sum())} moving points: {reason}"
    )


def what_went_wrong(recording: Recording, parameters: Parameters) -> str | None:
    """Fitness and displacement of the moving clusters that ICP aligned wrongly.

    None where there is none, or the truth of points is not known.
    """
    found = wrong = 0
    fitness: list[float] = []
    displacements: list[float] = []
    ways: list[float] = []
    for source_k, target_k in counting_pairs(recording, parameters.n):
        truth = recording.pair_truth(source_k, target_k, parameters.max_range)
        if truth is None or truth.points is None:
            continue
        flow = _flow(recording, source_k, target_k, parameters)
        interval = float(recording.stamps[target_k] - recording.stamps[source_k])
        off = list(_misaligned(flow, truth.points, interval))
        found += bool(flow.moving.any())
        wrong += bool(off)
        for result_fitness, displacement, way in off:
            fitness.append(result_fitness)
            displacements.append(displacement)
            ways.append(way)
    if not wrong:
        return None
    return (
        f"In {wrong} of {found} pairs with a flow ICP aligns the moving cluster wrongly: fitness "
        f"{span(fitness, '.2f')}, mean displacement {span(displacements, '.2f')} m, where it went "
        f"{span(ways, '.2f')} m."
    )


def _misaligned(
    flow: SceneFlow, points: NDArray[np.float64], interval: float
) -> Iterator[tuple[float, float, float]]:
    """(fitness, mean displacement m, true way m) of clusters that move, and wrongly."""
    for result in flow.clusters:
        if result.label != Label.MOVING:
            continue
        true = points[result.remaining]
        moving = np.linalg.norm(true, axis=1) > MOVING_SPEED
        if moving.mean() <= 0.5:  # what rests and was flagged is another error
            continue
        off, way = (
            float(np.linalg.norm(velocity[moving], axis=1).mean()) * interval
            for velocity in (result.velocity - true, true)
        )
        if off > _WRONG * way:
            yield result.fitness, result.mean_displacement, way


def _flow(recording: Recording, source_k: int, target_k: int, parameters: Parameters) -> SceneFlow:
    return estimate_scene_flow(
        recording.cloud(source_k, parameters.max_range),
        recording.cloud(target_k, parameters.max_range),
        float(recording.stamps[target_k] - recording.stamps[source_k]),
        parameters,
    )
