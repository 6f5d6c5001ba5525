"""Where the camera can stand: views that have a name."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.analysis.pairs import Pair
from app.scene.first_view import View, corners, first_view, spread
from app.scene.settings import ViewSettings
from estimator import Label

THREE_D, TOP, FRONT, ROBOT, FIT = "3D", "Top", "Front", "Robot", "Fit"
VIEWS = (THREE_D, TOP, FRONT, ROBOT, FIT)
"""At a slant; from above; from before the robot; from the robot's skin; everything."""

_MARGIN = 1.12
_ARROW_SCALE = ViewSettings().arrow_scale
_LEAN = 1e-3  # how far a view from above leans back, so that it is known which way is up in it


@dataclass(frozen=True)
class Film:
    """What a camera takes in.

    Attributes:
        fov: vertical field of view, rad.
        aspect: width by height of the picture.
    """

    fov: float
    aspect: float

    def distance(self, width: float, height: float) -> float:
        """Metres from which a thing of this size, in metres, fills the picture."""
        slope = np.tan(self.fov / 2)
        return _MARGIN / 2 * max(height / slope, width / (slope * self.aspect), 0.3)


def named_view(
    name: str,
    pair: Pair,
    R_drawing_fixed: NDArray[np.float64],
    film: Film,
    before: View | None = None,
) -> View:
    """The view of a pair that has this name.

    Args:
        name: one of `VIEWS`.
        pair: what is to be seen.
        R_drawing_fixed: (3, 3) from the fixed frame into one whose z axis points up.
        film: of the camera.
        before: where the camera stands now; what fits everything keeps looking that way.
    """
    points = pair.target.points @ R_drawing_fixed.T
    poses = pair.target.T_fixed_sensor
    placed = np.isfinite(poses).all(axis=(1, 2))
    poses = poses[placed]
    sensors = poses[:, :3, 3] @ R_drawing_fixed.T
    axes = poses[:, :3, 2] @ R_drawing_fixed.T
    slanted = first_view(
        pair.target.points,
        poses,
        R_drawing_fixed,
        film.fov,
        film.aspect,
        _arrows(pair),
    )
    moving, tips = (ends @ R_drawing_fixed.T for ends in _arrows(pair))
    if name == ROBOT and len(sensors):
        # Points come from sensors whose pose is known.
        owner = (np.cumsum(placed) - 1)[pair.target.sensor]
        return _from_robot(points, owner, sensors, axes, moving)
    if name == FIT:
        return _everything(points, sensors, film, before or slanted)
    box = np.vstack([*corners(points, sensors), *spread(moving), *spread(tips)])
    low, high = box.min(axis=0), box.max(axis=0)
    centre, (x, y, z) = (low + high) / 2, high - low
    if name == TOP:
        distance = film.distance(x, y) + z / 2
        return View(centre + distance * np.array([0.0, -_LEAN, 1.0]), centre)
    if name == FRONT:
        distance = film.distance(y, z) + x / 2
        return View(centre + distance * np.array([1.0, 0.0, 0.0]), centre)
    return slanted


def _arrows(pair: Pair) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The source points (M, 3) that were found to move, and where their arrows end at first."""
    if pair.source is None or pair.flow is None:
        return np.zeros((0, 3)), np.zeros((0, 3))
    moving = pair.flow.label == Label.MOVING
    points = pair.source.points[moving]
    return points, points + _ARROW_SCALE * pair.flow.velocity[moving]


def _from_robot(
    points: NDArray[np.float64],
    owner: NDArray[np.int64],
    sensors: NDArray[np.float64],
    axes: NDArray[np.float64],
    moving: NDArray[np.float64],
) -> View:
    """From the sensor that looks most at what moves; else from the one that sees most, as it looks.

    Args:
        points: (N, 3) metres, the target.
        owner: (N,) the sensor of each point, an index into the next two.
        sensors: (S, 3) metres, where they are.
        axes: (S, 3) unit vectors along which they look.
        moving: (M, 3) metres, what moves.
    """
    if len(moving):
        look_at = np.median(moving, axis=0)
        ways = look_at - sensors
        best = int(np.argmax((axes * ways).sum(axis=1) / np.linalg.norm(ways, axis=1)))
        if np.linalg.norm(ways[best]) >= 0.1:
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


def _everything(
    points: NDArray[np.float64], sensors: NDArray[np.float64], film: Film, before: View
) -> View:
    # A few points may be wild.
    box = np.percentile(points, [2, 98], axis=0) if len(points) else np.zeros((0, 3))
    seen = np.vstack([box, sensors])
    if len(seen) == 0:
        return before
    low, high = seen.min(axis=0), seen.max(axis=0)
    centre, size = (low + high) / 2, float(np.linalg.norm(high - low))
    direction = before.position - before.look_at
    direction = direction / np.linalg.norm(direction)
    return View(centre + film.distance(size, size) * direction, centre)
