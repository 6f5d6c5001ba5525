"""Named views: camera poses computed from a pair."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.analysis.pairs import Pair
from app.scene.drawn_flow import moving_ends
from app.scene.first_view import (
    View,
    filling_view,
    first_view,
    surroundings,
    without_outliers,
)
from app.scene.truth import truth_arrow

SLANTED, ABOVE, FRONT = "Slanted", "From above", "From the front"
SENSORS, FIT = "From the sensors", "Fit what moves"
VIEWS = (SLANTED, ABOVE, FRONT, SENSORS, FIT)
"""Named after where they look from; the last keeps that, and shows all where nothing moves."""
VIEW_FLAGS = {"3d": SLANTED, "top": ABOVE, "front": FRONT, "robot": SENSORS, "fit": FIT}
"""{name on the command line: view}."""

_SMALLEST = 0.12  # metres, smallest half extent of what fills the picture
_LEAN = 1e-3  # tilt of the view from above, which keeps its up direction defined
_DIRECTIONS = {ABOVE: np.array([0.0, -_LEAN, 1.0]), FRONT: np.array([1.0, 0.0, 0.0])}
"""{view: vector (3,) from what is seen to the camera}, about a unit long."""


@dataclass(frozen=True)
class Projection:
    """Perspective projection of a camera.

    Attributes:
        fov: vertical field of view, rad.
        aspect: width by height of the picture.
    """

    fov: float
    aspect: float


def named_view(
    name: str,
    pair: Pair,
    R_drawing_fixed: NDArray[np.float64],
    projection: Projection,
    before: View | None = None,
    objects: NDArray[np.float64] | None = None,
) -> View:
    """Compute the view of this name for a pair.

    Args:
        name: one of `VIEWS`.
        pair: to be shown.
        R_drawing_fixed: (3, 3) from the fixed frame into one whose z axis points up.
        projection: of the camera.
        before: the current view, whose direction `FIT` keeps; None for the slanted one's.
        objects: (N, 3) metres in the fixed frame, of true objects, which are in the picture
            whether or not they are drawn; None without any.
    """
    points = pair.target.points @ R_drawing_fixed.T
    poses = pair.target.T_fixed_sensor
    placed = np.isfinite(poses).all(axis=(1, 2))
    poses = poses[placed]
    sensors = poses[:, :3, 3] @ R_drawing_fixed.T
    axes = poses[:, :3, 2] @ R_drawing_fixed.T
    moving = np.vstack([without_outliers(ends @ R_drawing_fixed.T) for ends in moving_ends(pair)])
    fov, aspect = projection.fov, projection.aspect
    if name == SENSORS and len(sensors):
        # Only sensors with a known pose have points.
        owner = (np.cumsum(placed) - 1)[pair.target.sensor]
        starts = moving_ends(pair)[0] @ R_drawing_fixed.T
        return _from_sensor(points, owner, sensors, axes, starts)
    truth = _truth_ends(pair, R_drawing_fixed[2])
    shown = np.zeros((0, 3)) if objects is None else objects
    landmarks = np.vstack([_landmarks(pair), truth, shown]) @ R_drawing_fixed.T
    important = np.vstack([moving, landmarks])
    if name in _DIRECTIONS:
        seen = np.vstack([surroundings(points, sensors), important])
        return filling_view(seen, _DIRECTIONS[name], fov, aspect)
    in_fixed = important @ R_drawing_fixed
    slanted = first_view(pair.target.points, poses, R_drawing_fixed, fov, aspect, in_fixed)
    if name == FIT:
        seen = moving if len(moving) else np.vstack([without_outliers(points), sensors])
        kept = before or slanted
        direction = kept.position - kept.look_at
        direction = direction / np.linalg.norm(direction)
        return filling_view(seen, direction, fov, aspect, _SMALLEST) if len(seen) else slanted
    return slanted


def _landmarks(pair: Pair) -> NDArray[np.float64]:
    """Origins (N, 3) of the robot's links and of the true objects, where known."""
    poses = np.array([*pair.link_poses.values(), *pair.object_poses.values()]).reshape(-1, 4, 4)
    return poses[np.isfinite(poses).all(axis=(1, 2)), :3, 3]


def _truth_ends(pair: Pair, up: NDArray[np.float64]) -> NDArray[np.float64]:
    """Both ends (2, 3) of the truth's arrow, (0, 3) without one."""
    start, velocity = truth_arrow(pair, up)
    return (
        np.zeros((0, 3))
        if velocity is None
        else np.stack([start, start + pair.interval * velocity])
    )


def _from_sensor(
    points: NDArray[np.float64],
    owner: NDArray[np.int64],
    sensors: NDArray[np.float64],
    axes: NDArray[np.float64],
    moving: NDArray[np.float64],
) -> View:
    """View from the sensor best aimed at the moving points, or else from the one with most points.

    Args:
        points: (N, 3) metres, the target.
        owner: (N,) index of each point's sensor into `sensors` and `axes`.
        sensors: (S, 3) metres.
        axes: (S, 3) unit vectors along their optical axes.
        moving: (M, 3) metres, the moving points.
    """
    if len(moving):
        look_at = np.median(moving, axis=0)
        offsets = look_at - sensors
        best = int(np.argmax((axes * offsets).sum(axis=1) / np.linalg.norm(offsets, axis=1)))
        if np.linalg.norm(offsets[best]) >= 0.1:
            return View(sensors[best] + 0.01 * axes[best], look_at)
    counts = np.bincount(owner, minlength=len(sensors))
    depths = np.full(len(sensors), np.inf)
    for sensor in np.flatnonzero(counts):
        depths[sensor] = np.median(
            np.linalg.norm(points[owner == sensor] - sensors[sensor], axis=1)
        )
    best = int(np.lexsort((depths, -counts))[0])
    depth = max(depths[best], 0.5) if np.isfinite(depths[best]) else 0.5
    return View(sensors[best] + 0.01 * axes[best], sensors[best] + depth * axes[best])
