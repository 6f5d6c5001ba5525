"""Cameras of a figure's views, whose pictures are filled by what moves and what sees it."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from app.analysis.moving_targets import moving_targets
from app.analysis.pairs import Pair
from app.exports.pinhole import filling
from app.scene.camera import Camera
from app.scene.drawn_flow import moving_ends
from app.scene.lens import FOV, WIDE_FOV
from app.scene.scene_root import upright
from app.scene.shapes import box_corners, corners_of, robot_shape
from app.scene.truth import object_corners
from app.scene.views import ABOVE, FRONT, SENSORS, SLANTED, Projection, named_view
from recordings import Recording

_FILLED = (SLANTED, ABOVE, FRONT)
"""Views from a distance; the others look at something of their own."""

_FRUSTUM = 0.11  # metres that a sensor's frustum reaches
_KEPT = (1.0, 99.0)
"""Percentiles of what moves that bound its view; a single stray point does not."""


FigureView = str | Camera
"""View of a figure: one of `VIEWS`, or a camera of its own."""


def figure_camera(
    recording: Recording,
    pairs: Sequence[Pair],
    view: FigureView,
    aspect: float,
    free_below: float = 0.0,
) -> Camera:
    """The camera of a view in a figure.

    Args:
        recording: of the pairs.
        pairs: to be shown, at least one; several are those of an animation.
        view: of the figure.
        aspect: width by height of the view.
        free_below: part of the view's height that stays free at its lower edge.
    """
    if isinstance(view, Camera):
        return view
    R_drawing_fixed = upright(recording.fixed_frame)
    projection = Projection(WIDE_FOV if view == SENSORS else FOV, aspect)
    moving = [pair for pair in pairs if pair.anything_moves]
    middle = moving[len(moving) // 2] if moving else pairs[len(pairs) // 2]
    objects = object_corners(recording.object_meshes, middle)
    placed = named_view(view, middle, R_drawing_fixed, projection, objects=objects)
    camera = Camera.of(placed.position, placed.look_at, projection.fov)
    if view not in _FILLED or not moving:
        return camera
    seen = [
        points
        for pair in moving
        for points in (_moving(pair), _sensors(pair), _robot(recording, pair))
    ]
    return filling(camera, aspect, np.vstack(seen) @ R_drawing_fixed.T, free_below)


def _moving(pair: Pair) -> NDArray[np.float64]:
    """Corners (M, 3) of the boxes around moving source points, where they went, and targets."""
    points, tips = moving_ends(pair)
    if len(points) == 0:
        return np.zeros((0, 3))
    sets = (points, tips, pair.target.points[moving_targets(pair)])
    boxes = [box_corners(*np.percentile(points, _KEPT, axis=0)) for points in sets if len(points)]
    return np.vstack(boxes) if boxes else np.zeros((0, 3))


def _sensors(pair: Pair) -> NDArray[np.float64]:
    """Sensors with a known pose, and the ends of their frustums, (M, 3)."""
    poses = pair.target.T_fixed_sensor
    poses = poses[np.isfinite(poses).all(axis=(1, 2))]
    return np.vstack([poses[:, :3, 3], poses[:, :3, 3] + _FRUSTUM * poses[:, :3, 2]])


def _robot(recording: Recording, pair: Pair) -> NDArray[np.float64]:
    """Corners (M, 3) of the boxes around the robot's meshes."""
    corners = [np.zeros((0, 3))]
    if recording.robot:
        for link, parts in robot_shape(recording.robot).links.items():
            pose = pair.link_poses.get(link)
            if pose is not None and np.isfinite(pose).all():
                corners += [corners_of(part.vertices, pose) for part in parts]
    return np.vstack(corners)
