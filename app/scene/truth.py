"""Geometry of the truth's arrow, of the true object, and of the points that stand for it."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from app.analysis.pairs import Pair
from app.scene.shapes import corners_of
from estimator import truly_moves
from recordings import ObjectMesh

_ABOVE = 0.1  # height of the arrow above all moving points, metres


def truth_arrow(
    pair: Pair, up: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64] | None]:
    """Tail (3,) and velocity (3,) of the truth's arrow, just above the moving points.

    Args:
        pair: with its truth; without one, the velocity is None.
        up: unit vector in the fixed frame.
    """
    velocity = pair.object_velocity
    if velocity is None or pair.source is None:
        return np.zeros(3), None
    points = pair.source.points[pair.truly_moving]
    middle = np.median(points, axis=0)
    above = float(((points - middle) @ up).max()) + _ABOVE
    return middle + above * up, velocity


def object_points(pair: Pair) -> NDArray[np.float64]:
    """Moving source points displaced by their true motion over the interval, (M, 3)."""
    if pair.source is None or pair.truth is None or pair.truth.points is None:
        return np.zeros((0, 3))
    displacement = pair.interval * pair.truth.points
    moving = truly_moves(pair.truth.points)
    return pair.source.points[moving] + displacement[moving]


def object_corners(meshes: Mapping[str, ObjectMesh], pair: Pair) -> NDArray[np.float64]:
    """Corners (8 M, 3) of boxes around the true objects at frame k, metres in the fixed frame.

    Args:
        meshes: {frame: surface} of the recording.
        pair: (k-n, k).
    """
    corners = [np.zeros((0, 3))]
    for frame, mesh in meshes.items():
        T_fixed_object = pair.object_poses.get(frame)
        if (
            T_fixed_object is None
            or not np.isfinite(T_fixed_object).all()
            or not len(mesh.vertices)
        ):
            continue
        corners.append(corners_of(mesh.vertices, T_fixed_object))
    found = np.vstack(corners)
    return found[np.isfinite(found).all(axis=1)]


def object_is_known(pair: Pair) -> bool:
    """Whether the true object of a pair can be drawn, by its surface or by points."""
    placed = (bool(np.isfinite(pose).all()) for pose in pair.object_poses.values())
    return len(object_points(pair)) > 0 or any(placed)
