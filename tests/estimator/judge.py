"""Algorithm 1 and the baseline once more, written from the paper alone, as plainly as possible."""

import numpy as np
import open3d as o3d
from numpy.typing import NDArray
from sklearn.cluster import HDBSCAN

UNASSIGNED, STATIONARY, MOVING = 0, 1, 2


def judge(
    source: NDArray[np.float64],
    target: NDArray[np.float64],
    interval: float,
    *,
    gamma: float = 0.7,
    delta: float = 0.04,
    n_min: int = 60,
    reach: float = 0.10,
    min_cluster_size: int = 20,
    gate: bool = True,
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Labels (N,) and velocities (N, 3) of the source; without `gate`, the paper's baseline."""
    label = np.zeros(len(source), dtype=np.int64)
    velocity = np.full((len(source), 3), np.nan)

    merged = np.concatenate([target, source])
    cluster_of = HDBSCAN(min_cluster_size=min_cluster_size, copy=True).fit(merged).labels_  # type: ignore[arg-type]
    for c in sorted(set(cluster_of.tolist()) - {-1}):
        members = np.nonzero(cluster_of == c)[0].tolist()
        in_target = [i for i in members if i < len(target)]
        in_source = [i - len(target) for i in members if i >= len(target)]

        for _ in range(20):
            if len(in_target) < n_min and len(in_source) < n_min:
                break
            if len(in_target) < 3 or len(in_source) < 3:
                break

            result = o3d.pipelines.registration.registration_icp(
                cloud(source[in_source]), cloud(target[in_target]), reach
            )
            homogeneous = np.column_stack([source[in_source], np.ones(len(in_source))])
            D = (homogeneous @ result.transformation.T)[:, :3] - source[in_source]

            if not gate:
                label[in_source] = MOVING
                velocity[in_source] = D / interval
                break
            if result.fitness > gamma:
                if np.mean([np.linalg.norm(d) for d in D]) < delta:
                    label[in_source] = STATIONARY
                else:
                    label[in_source] = MOVING
                    velocity[in_source] = D / interval
                break

            pairs = np.asarray(result.correspondence_set).reshape(-1, 2).tolist()
            if not pairs:
                break
            gone_source = {in_source[i] for i, _ in pairs}
            gone_target = {in_target[j] for _, j in pairs}
            label[sorted(gone_source)] = STATIONARY
            in_source = [i for i in in_source if i not in gone_source]
            in_target = [j for j in in_target if j not in gone_target]
    return label, velocity


def cloud(points: NDArray[np.float64]) -> o3d.geometry.PointCloud:
    return o3d.geometry.PointCloud(o3d.utility.Vector3dVector(points))
