"""Point-to-point ICP as Open3D does it, compiled: the same steps, the same result.

It gives no answer where that hangs on rounding, since Open3D's rounding is not known here.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from estimator.engine.compiled import compiled
from estimator.engine.nearest import NONE, Grid, make_grid, nearest_two
from estimator.engine.rigid_motion import rigid_motion
from estimator.flow import Indices
from estimator.icp import Registration

Floats = NDArray[np.float64]

_ITERATIONS = 30
_CONVERGED = 1e-6
"""ICP stops when fitness and rmse (metres) change by less: `estimator.icp`'s criteria."""

_ROUNDING = 1e-12
"""Share of the largest coordinate below which two distances are held to be equal."""

_LARGEST = 1e100
"""Metres beyond which squares might overflow."""

_EPSILON = 2.0**-52
_OPEN = 1e-10
"""Radians: where rounding might turn the source by more, the pairs leave the rotation open."""

_MARGIN = 0.5
"""How far a search looks beyond the nearest point or the reach, in widths of a cell."""

_UNDECIDED = -1
_UNKNOWN = -2


def align(
    source: Floats, target: Floats, max_correspondence_distance: float
) -> Registration | None:
    """Find what `estimator.icp.align` finds, without the GIL.

    Args:
        source: (N, 3) metres, N > 0, finite.
        target: (M, 3) metres, M > 0, finite.
        max_correspondence_distance: metres.

    Returns:
        The registration: correspondences and fitness are those of `estimator.icp.align`, the
        rotation is within 1e-9, and the translation and rmse are within 1e-9 and 1e-12 of the
        largest coordinate (of 1 m at least). None where rounding decides: two target points at
        the same distance from a source point, one at the limit, pairs that leave the rotation
        open (two, or all in a line), a change of rmse at the limit of convergence. None also for
        what `estimator.icp.align` complains of: no points, or no distance.
    """
    transformation = np.eye(4)
    inlier_source = np.empty(len(source), np.intp)
    inlier_target = np.empty(len(source), np.intp)
    count, rmse = _align(
        # Copies are always of the one type that is compiled: writable, and row by row.
        np.array(source, np.float64, order="C"),
        np.array(target, np.float64, order="C"),
        float(max_correspondence_distance),
        transformation,
        inlier_source,
        inlier_target,
    )
    if count < 0:
        return None
    return Registration(
        transformation=transformation,
        fitness=count / len(source),
        inlier_rmse=rmse,
        inlier_source=inlier_source[:count],
        inlier_target=inlier_target[:count],
    )


class _Found(NamedTuple):
    """What the last search of each source point found.

    Attributes:
        nearest: (N,) place of the nearest target point in the grid, NONE within the limit, or
            _UNKNOWN before the first search.
        bound: (N,) metres, no other target point was nearer.
        place: (N, 3) metres, where the source point was.
    """

    nearest: Indices
    bound: Floats
    place: Floats


@compiled
def _align(
    source: Floats, target: Floats, reach: float, T: Floats, paired: Indices, partner: Indices
) -> tuple[int, float]:
    """Run ICP; T is the identity at first and the transformation in the end.

    Returns:
        Number of pairs, whose rows are written into `paired` and `partner`, and their root mean
        square distance; _UNDECIDED pairs where rounding decides.
    """
    size = len(source)
    largest = max(_largest(source), _largest(target))
    if not (largest < _LARGEST and reach > 0.0):
        return _UNDECIDED, 0.0
    turn, rounding = 0.0, _ROUNDING * largest
    grid = make_grid(target)
    moved, motion = source.copy(), np.eye(4)
    found = _Found(np.full(size, _UNKNOWN), np.empty(size), np.empty((size, 3)))

    count, rmse = _pair(moved, grid, reach, rounding, found, paired, partner)
    for _ in range(_ITERATIONS):
        if count <= 0:  # nothing moves any more, or undecided
            break
        eigenvalue, gap = rigid_motion(moved, target, paired, partner, count, motion)
        if count > 1:
            turn += _EPSILON * largest * np.sqrt(count * eigenvalue) / gap
        if not turn < _OPEN:
            return _UNDECIDED, 0.0
        rounding = (_ROUNDING + turn) * largest
        _move(moved, motion)
        _compose(motion, T)
        count_before, rmse_before = count, rmse
        count, rmse = _pair(moved, grid, reach, rounding, found, paired, partner)
        if abs(count_before / size - count / size) < _CONVERGED:
            change = abs(rmse_before - rmse)
            if abs(change - _CONVERGED) <= rounding:
                return _UNDECIDED, 0.0
            if change < _CONVERGED:
                break
    if count < 0:
        return _UNDECIDED, 0.0
    return count, _distance(source, target, paired, partner, count, T)


@compiled
def _largest(points: Floats) -> float:
    """Largest coordinate without its sign, infinite where there is none or one is not finite."""
    largest = 0.0 if len(points) else np.inf
    for i in range(len(points)):
        for axis in range(3):
            size = abs(points[i, axis])
            largest = max(largest, size if np.isfinite(size) else np.inf)
    return largest


@compiled
def _pair(
    points: Floats,
    grid: Grid,
    reach: float,
    rounding: float,
    found: _Found,
    paired: Indices,
    partner: Indices,
) -> tuple[int, float]:
    """Pair points with the nearest in the grid that is nearer than `reach`.

    Since a point's last search, the distances of all others than the nearest one have fallen by no
    more than the way the point has moved: it is searched again only where one may be nearer now.

    Returns:
        Number of pairs and their root mean square distance; _UNDECIDED where rounding decides.
    """
    nearest, bound, place = found
    count, squares = 0, 0.0
    margin = _MARGIN * grid.width + 2.0 * rounding
    limit = reach + margin
    expected = grid.width
    for i in range(len(points)):
        x, y, z = points[i, 0], points[i, 1], points[i, 2]
        k, distance, others = nearest[i], np.inf, -np.inf
        if k != _UNKNOWN:
            others = bound[i] - _length(x - place[i, 0], y - place[i, 1], z - place[i, 2])
            if k != NONE:
                distance = _length(
                    x - grid.points[k, 0], y - grid.points[k, 1], z - grid.points[k, 2]
                )
                expected = distance
        if others <= min(distance, reach) + rounding:
            k, distance, others = nearest_two(grid, x, y, z, min(expected + margin, limit), limit)
            if others <= min(distance, reach) + rounding:
                return _UNDECIDED, 0.0
            nearest[i], bound[i] = k, others
            place[i, 0], place[i, 1], place[i, 2] = x, y, z
            expected = min(distance, reach)
        if abs(distance - reach) <= rounding:
            return _UNDECIDED, 0.0
        if distance < reach:
            paired[count], partner[count] = i, grid.row[k]
            count += 1
            squares += distance * distance
    return count, np.sqrt(squares / count) if count else 0.0


@compiled
def _length(x: float, y: float, z: float) -> float:
    return np.sqrt((x * x + y * y) + z * z)


@compiled
def _move(points: Floats, motion: Floats) -> None:
    """Move points (N, 3), in the order of additions that Open3D has."""
    for i in range(len(points)):
        x, y, z = points[i, 0], points[i, 1], points[i, 2]
        for a in range(3):
            points[i, a] = motion[a, 0] * x + motion[a, 1] * y + motion[a, 2] * z + motion[a, 3]


@compiled
def _compose(motion: Floats, T: Floats) -> None:
    """Make T (4, 4) the motion after T."""
    for column in range(4):
        x, y, z, w = T[0, column], T[1, column], T[2, column], T[3, column]
        for a in range(3):
            T[a, column] = motion[a, 0] * x + motion[a, 1] * y + motion[a, 2] * z + motion[a, 3] * w


@compiled
def _distance(
    source: Floats, target: Floats, paired: Indices, partner: Indices, count: int, T: Floats
) -> float:
    """Root mean square distance of pairs, the source moved by T (4, 4)."""
    squares = 0.0
    for k in range(count):
        i, j = paired[k], partner[k]
        x, y, z = source[i, 0], source[i, 1], source[i, 2]
        for a in range(3):
            gap = T[a, 0] * x + T[a, 1] * y + T[a, 2] * z + T[a, 3] - target[j, a]
            squares += gap * gap
    return np.sqrt(squares / count) if count else 0.0
