"""Steps shared by Algorithm 1 and the baseline: the size test and one ICP round of a cluster."""

import numpy as np
from numpy.typing import NDArray

from estimator.engines import Engine, current_engine
from estimator.flow import IcpRound, Indices
from estimator.parameters import PARAMETER_INFO, Parameters
from estimator.window import Window

MIN_POINTS = 3
THRESHOLDS = ("gamma", "delta")
"""Parameters of the two steps that Algorithm 1 adds."""

USED = tuple(name for name in PARAMETER_INFO if name not in ("method", *THRESHOLDS))
"""Parameters that clusters and rounds depend on."""


def too_few_points(source: Indices, target: Indices, parameters: Parameters) -> str | None:
    """Reason why a cluster has too few points, None where it has enough.

    N_min skips a cluster when both clouds are below it (AND, as in the pseudocode; the prose
    reads like OR). For any N_min, a rigid motion needs three points in each cloud.
    """
    sizes = f"{len(source)} source and {len(target)} target points"
    if len(source) < parameters.n_min and len(target) < parameters.n_min:
        return f"{sizes}, both below N_min {parameters.n_min}"
    if min(len(source), len(target)) < MIN_POINTS:
        return f"{sizes}, and ICP needs {MIN_POINTS} in each"
    return None


def icp_round(
    source: Indices, target: Indices, window: Window, parameters: Parameters
) -> tuple[IcpRound, NDArray[np.float64]]:
    """Lines 8-12 of Algorithm 1: ICP, its transformation, and the displacements D^C.

    The ICP result is cached, so that new thresholds do not run it again.

    Returns:
        The round, and D^C (len(source), 3) in metres.
    """
    reach, engine = parameters.max_correspondence_distance, current_engine()
    current = window.stages.get(
        ("icp", engine.name, reach, source.tobytes(), target.tobytes()),
        lambda: _round(source, target, window, reach, engine),
    )
    return current, displaced(window.source.points[source], current.transformation)


def _round(
    source: Indices, target: Indices, window: Window, reach: float, engine: Engine
) -> IcpRound:
    points = window.source.points[source]
    icp = engine.align(points, window.target.points[target], reach)
    displacement = displaced(points, icp.transformation)
    return IcpRound(
        source_size=len(source),
        target_size=len(target),
        fitness=icp.fitness,
        inlier_rmse=icp.inlier_rmse,
        transformation=icp.transformation,
        mean_displacement=float(np.linalg.norm(displacement, axis=1).mean()),
        inlier_source=source[icp.inlier_source],
        inlier_target=target[icp.inlier_target],
    )


def displaced(
    points: NDArray[np.float64], transformation: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Displacements (N, 3) of points (N, 3) by a transformation (4, 4), metres (line 12)."""
    R, t = transformation[:3, :3], transformation[:3, 3]
    return points @ R.T + t - points
