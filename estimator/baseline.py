"""The paper's baseline: clustering and ICP without the two added steps (section III-B)."""

from estimator.clustering import Cluster, clusters_of
from estimator.flow import ClusterResult, Label, SceneFlow, cluster_result, scene_flow
from estimator.method import Method
from estimator.parameters import Parameters
from estimator.rounds import USED, icp_round, too_few_points
from estimator.window import Window


def baseline(window: Window, parameters: Parameters) -> SceneFlow:
    """Move every cluster of at least N_min points by its first ICP; no gate, no removal."""
    clusters = clusters_of(window, parameters)
    return scene_flow(
        len(window.source.points), [_move(cluster, window, parameters) for cluster in clusters]
    )


def _move(cluster: Cluster, window: Window, parameters: Parameters) -> ClusterResult:
    if reason := too_few_points(cluster.source, cluster.target, parameters):
        return cluster_result(cluster, cluster.source, [], Label.UNASSIGNED, reason)
    current, displacement = icp_round(cluster.source, cluster.target, window, parameters)
    reason = (
        f"the baseline moves every cluster: fitness {current.fitness:.2f}, "
        f"mean displacement {current.mean_displacement:.3f} m"
    )
    velocity = displacement / window.interval
    return cluster_result(cluster, cluster.source, [current], Label.MOVING, reason, velocity)


BASELINE = Method("baseline", baseline, uses=USED)
