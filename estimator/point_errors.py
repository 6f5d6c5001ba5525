"""Errors of single points of a pair, and their sums cluster by cluster."""

import numpy as np
from numpy.typing import NDArray

MOVING_SPEED = 0.01
"""Speed in m/s above which the truth counts as motion."""

STRICT, RELAXED, OUTLYING = 0.05, 0.10, 0.30
"""AccS: e below STRICT metres or r below STRICT; AccR likewise with RELAXED; an outlier: e above
OUTLYING metres or r above RELAXED."""

RELATIVE_EPSILON = 1e-4
"""Metres in the denominator of r, as in HPLFlowNet (Argoverse 2 has 1e-10, ICP-Flow 1e-20)."""

ERRORS = (
    "angle_deg",
    "velocity_error",
    "coverage",
    "precision",
    "epe3d",
    "acc_s",
    "acc_r",
    "outliers",
    "dynamic_iou",
    "false_flow",
)
"""Fields of `Metrics` that are means over points, in the order of the columns below."""


def point_errors(
    moving: NDArray[np.bool_],
    velocity: NDArray[np.float64],
    interval: float,
    object_velocity: NDArray[np.float64],
    point_velocity: NDArray[np.float64] | None,
) -> NDArray[np.float64]:
    """What each point adds to each mean.

    Args:
        moving: (N,) whether a point has a flow.
        velocity: (N, 3) m/s, its flow.
        interval: seconds between the two stamps.
        object_velocity: (N, 3) m/s of the moving object, as if each point belonged to it.
        point_velocity: (N, 3) m/s of each point itself, NaN where unknown; None without.

    Returns:
        (N, len(ERRORS)), a column for each of `ERRORS`; NaN where a point does not enter it.
    """
    errors = np.full((len(moving), len(ERRORS)), np.nan)
    column = dict(zip(ERRORS, errors.T, strict=True))
    estimated, true = velocity[moving], object_velocity[moving]
    column["angle_deg"][moving] = angles_deg(estimated, true)
    column["velocity_error"][moving] = lengths(estimated - true)
    if point_velocity is None:
        return errors
    known = np.asarray(np.isfinite(point_velocity).all(axis=1))
    truly = truly_moves(point_velocity)
    _where(column["coverage"], known & truly, moving)
    _where(column["precision"], known & moving, truly)
    _where(column["dynamic_iou"], known & (moving | truly), moving & truly)
    _where(column["false_flow"], known & ~truly, moving)
    by_flow = np.where(moving[:, None], velocity, 0.0)
    e = lengths(by_flow - point_velocity) * interval
    f = lengths(point_velocity) * interval
    r = e / (f + RELATIVE_EPSILON)
    _where(column["epe3d"], known, e)
    _where(column["acc_s"], known, (e < STRICT) | (r < STRICT))
    _where(column["acc_r"], known, (e < RELAXED) | (r < RELAXED))
    _where(column["outliers"], known, (e > OUTLYING) | (r > RELAXED))
    return errors


def _where(
    column: NDArray[np.float64],
    enters: NDArray[np.bool_],
    values: NDArray[np.float64] | NDArray[np.bool_],
) -> None:
    column[enters] = values[enters]


def sums_of_groups(
    values: NDArray[np.float64], group: NDArray[np.intp], size: int
) -> NDArray[np.float64]:
    """Sum and number of the finite values of each group and column.

    A sum is taken value by value in the order of the rows, so that it is the same to the last bit
    wherever the rows of a group come from.

    Args:
        values: (N, M).
        group: (N,) group of each row, from 0.
        size: number of groups.

    Returns:
        (size, 2 M), for each column its sum and the number of its values.
    """
    sums = np.zeros((size, 2 * values.shape[1]))
    for at, column in enumerate(values.T):
        finite = np.isfinite(column)
        sums[:, 2 * at] = np.bincount(group[finite], column[finite], size)
        sums[:, 2 * at + 1] = np.bincount(group[finite], minlength=size)
    return sums


def truly_moves(velocity: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Mask (N,) of velocities (N, 3) m/s above `MOVING_SPEED`; False where unknown (NaN)."""
    return lengths(velocity) > MOVING_SPEED


def angles_deg(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Angles (N,) in degrees between vectors (N, 3), NaN where one is zero."""
    # atan2 keeps its accuracy at small angles, where the paper's acos loses half the digits.
    (ax, ay, az), (bx, by, bz) = a.T, b.T
    across = np.sqrt((ay * bz - az * by) ** 2 + (az * bx - ax * bz) ** 2 + (ax * by - ay * bx) ** 2)
    along = ax * bx + ay * by + az * bz
    return np.where(lengths(a) * lengths(b) > 0, np.degrees(np.arctan2(across, along)), np.nan)


def lengths(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Lengths (N,) of vectors (N, 3); several times as fast as NumPy's `norm` along rows."""
    x, y, z = vectors.T
    return np.sqrt(x * x + y * y + z * z)
