"""Algorithm 1 of the paper, line by line.

Choices where the paper leaves something open; those that users may want to change are parameters:

- ICP runs from the source P_{k-n} to the target P_k, with `max_correspondence_distance`.
- Inliers are the corresponding points of both clouds, and leave both.
- After a removal the loop goes on at the test of N_min. It ends without a classification when
  nothing could be removed or after 20 rounds; what is left then is Unassigned.
- V belongs to the remaining points; removed inliers did not move and are Stationary.
"""

from estimator.clustering import Cluster, clusters_of
from estimator.flow import (
    ClusterResult,
    IcpRound,
    Label,
    SceneFlow,
    cluster_result,
    scene_flow,
    without,
)
from estimator.method import Method
from estimator.parameters import Parameters
from estimator.rounds import THRESHOLDS, USED, icp_round, too_few_points
from estimator.window import Window

MAX_ROUNDS = 20


def algorithm_1(window: Window, parameters: Parameters) -> SceneFlow:
    """Estimate the scene flow of one pair (section II-B)."""
    clusters = clusters_of(window, parameters)  # lines 1-2: merge, HDBSCAN
    results = [classify(cluster, window, parameters) for cluster in clusters]  # line 3
    return scene_flow(len(window.source.points), results)


def classify(cluster: Cluster, window: Window, parameters: Parameters) -> ClusterResult:
    """Lines 4-22 for one cluster; the numbers in the comments are the pseudocode's lines."""
    gamma, delta = parameters.gamma, parameters.delta
    source, target = cluster.source, cluster.target  # 4
    rounds: list[IcpRound] = []

    while len(rounds) < MAX_ROUNDS:
        if reason := too_few_points(source, target, parameters):  # 5-7
            return cluster_result(cluster, source, rounds, Label.UNASSIGNED, reason)

        current, displacement = icp_round(source, target, window, parameters)  # 8-12
        rounds.append(current)

        if current.fitness > gamma:  # 13
            reached = f"fitness {current.fitness:.2f} above γ {gamma:g}"
            moved = f"mean displacement {current.mean_displacement:.3f} m"
            if current.mean_displacement < delta:  # 14-15
                reason = f"{reached}, {moved} below δ {delta:g} m"
                return cluster_result(cluster, source, rounds, Label.STATIONARY, reason)
            reason = f"{reached}, {moved} not below δ {delta:g} m"  # 16-18
            velocity = displacement / window.interval
            return cluster_result(cluster, source, rounds, Label.MOVING, reason, velocity)

        if len(current.inlier_source) == 0:
            reason = "no point is near enough to the other cloud to be paired"
            return cluster_result(cluster, source, rounds, Label.UNASSIGNED, reason)
        source = without(source, current.inlier_source)  # 20-21
        target = without(target, current.inlier_target)

    reason = f"fitness not above γ {gamma:g} in {MAX_ROUNDS} rounds"
    return cluster_result(cluster, source, rounds, Label.UNASSIGNED, reason)


ALGORITHM_1 = Method("paper", algorithm_1, title="Algorithm 1", uses=(*USED, *THRESHOLDS))
