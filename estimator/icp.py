"""Point-to-point ICP by Open3D."""

from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from estimator.flow import Indices
from estimator.libraries import open3d


@dataclass(frozen=True)
class Registration:
    """Result of ICP.

    Attributes:
        transformation: (4, 4), takes source points onto the target.
        fitness: inlier correspondences / source points.
        inlier_rmse: root mean square distance of the inliers, metres.
        inlier_source: rows of the source that have a correspondence.
        inlier_target: rows of the target that they correspond to, in the same order.
    """

    transformation: NDArray[np.float64]
    fitness: float
    inlier_rmse: float
    inlier_source: Indices
    inlier_target: Indices


def align(
    source: NDArray[np.float64], target: NDArray[np.float64], max_correspondence_distance: float
) -> Registration:
    """Find the rigid motion that takes `source` onto `target`, starting from the identity.

    The source is P_{k-n} and the target P_k, as the paper's text says; its pseudocode lists the
    arguments the other way round.

    Args:
        source: (N, 3) metres, N > 0.
        target: (M, 3) metres, M > 0.
        max_correspondence_distance: metres.
    """
    result = open3d().pipelines.registration.registration_icp(
        _point_cloud(source),
        _point_cloud(target),
        max_correspondence_distance,
        np.eye(4),
        *_settings(),
    )
    correspondences = np.asarray(result.correspondence_set, dtype=np.intp).reshape(-1, 2)
    transformation = np.array(result.transformation)
    R, t = transformation[:3, :3], transformation[:3, 3]
    gaps = source[correspondences[:, 0]] @ R.T + t - target[correspondences[:, 1]]
    squares = np.einsum("ij,ij->i", gaps, gaps)
    return Registration(
        transformation=transformation,
        fitness=float(result.fitness),
        # Open3D's own value varies in the last digit with its threads.
        inlier_rmse=float(np.sqrt(squares.mean())) if len(squares) else 0.0,
        inlier_source=correspondences[:, 0],
        inlier_target=correspondences[:, 1],
    )


@cache
def _settings() -> tuple[Any, Any]:
    """Open3D's point-to-point estimation, and its default convergence criteria.

    They are given explicitly since fitness depends on where ICP stops.
    """
    registration = open3d().pipelines.registration
    criteria = registration.ICPConvergenceCriteria(
        relative_fitness=1e-6, relative_rmse=1e-6, max_iteration=30
    )
    return registration.TransformationEstimationPointToPoint(), criteria


def _point_cloud(points: NDArray[np.float64]) -> Any:  # noqa: ANN401 (Open3D has no types)
    o3d = open3d()
    return o3d.geometry.PointCloud(o3d.utility.Vector3dVector(points))
