"""Why nothing got a flow."""

from collections import Counter

import numpy as np

from app.evaluation import counting_pairs
from estimator import MOVING_SPEED, Parameters, estimate_scene_flow
from recordings import Recording


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
    flow = estimate_scene_flow(
        recording.cloud(source_k, parameters.max_range),
        recording.cloud(target_k, parameters.max_range),
        float(recording.stamps[target_k] - recording.stamps[source_k]),
        parameters,
    )
    moving = np.linalg.norm(truth.points, axis=1) > MOVING_SPEED
    if not moving.any():
        return None
    cluster, count = Counter(flow.cluster[moving].tolist()).most_common(1)[0]
    reason = "in no cluster." if cluster < 0 else flow.clusters[cluster].reason
    return (
        f"Frames {source_k} and {target_k}, {count} of {int(moving.sum())} moving points: {reason}"
    )
