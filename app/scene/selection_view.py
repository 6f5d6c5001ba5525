"""Drawing of the picked cluster: larger points, a bounding box and a label."""

import itertools

import numpy as np
import viser
from numpy.typing import NDArray

from app.analysis.pairs import Pair
from app.analysis.selection import points_of
from app.scene.camera import Camera
from app.scene.palettes import Palette
from app.scene.scene_root import FIXED
from app.scene.shapes import box_corners
from estimator import ClusterResult

PICKED_NODE = f"{FIXED}/picked"

_LARGER = 1.2  # radius of a picked point, relative to others that move
_THICKNESS = 1.0  # pixels, of the box's lines
_IN_VIEW = 0.6  # of half the field of view, within which the label's cluster is looked for
_TOP = 0.85  # of half the picture's height, up to which the label is kept
_BESIDE = 1.4  # half a picture's width, relative to half its height
_MARGIN = 0.015  # metres between the points and the box around them
_CORNERS = box_corners(np.zeros(3), np.ones(3))
_EDGES = np.array(
    [
        (a, b)
        for a, b in itertools.combinations(range(8), 2)
        if (_CORNERS[a] != _CORNERS[b]).sum() == 1
    ]
)


class SelectionView:
    """Draws the picked cluster, if any.

    Attributes:
        points: the picked source points.
    """

    def __init__(self, scene: viser.SceneApi, palette: Palette, point_size: float) -> None:
        self._frame = scene.add_frame(PICKED_NODE, show_axes=False, visible=False)
        self.points = scene.add_point_cloud(
            f"{PICKED_NODE}/points",
            np.zeros((0, 3)),
            palette.picked,
            point_size=_LARGER * point_size,
            point_shape="circle",
            point_shading="flat",
            precision="float32",
        )
        self._box = scene.add_line_segments(
            f"{PICKED_NODE}/box",
            np.zeros((12, 2, 3)),
            palette.picked,
            thickness=_THICKNESS,
            thickness_units="screen",
        )
        self._label = scene.add_label(f"{PICKED_NODE}/label", "", anchor="bottom-center")
        self._drawn: NDArray[np.float64] = np.zeros((0, 3))
        self._corners: NDArray[np.float64] = np.zeros((8, 3))
        self._up = np.array([0.0, 0.0, 1.0])

    def show(self, pair: Pair, cluster: ClusterResult | None, up: NDArray[np.float64]) -> None:
        """Draw a cluster of a pair as picked, or none.

        Args:
            pair: whose flow contains the cluster.
            cluster: to draw, None for none.
            up: (3,) unit vector in the fixed frame.
        """
        if cluster is None or pair.source is None:
            self._frame.visible = False
            return
        points = points_of(pair, cluster)
        self._drawn, self._up = points, up
        self.points.points = pair.source.points[cluster.source].astype(np.float32)
        self._corners = corners_around(points)
        self._box.points = self._corners[_EDGES].astype(np.float32)
        self._label.text = label_text(cluster)
        self._frame.visible = True

    def fit(self, camera: Camera) -> None:
        """Suit a camera in the fixed frame: the label stays in its picture, a huge box goes."""
        if len(self._drawn) == 0:
            return
        self._box.visible = _mostly_seen(self._corners, camera)
        rays = self._drawn - camera.position
        away = np.linalg.norm(np.cross(rays, camera.direction), axis=1)
        seen = away < (rays @ camera.direction) * np.tan(_IN_VIEW * camera.fov / 2)
        points = self._drawn[seen] if seen.any() else self._drawn
        middle = points.mean(axis=0)
        above = float(((points - middle) @ self._up).max()) + 2 * _MARGIN
        self._label.position = _kept_below_top(middle + above * self._up, self._up, camera)

    def paint(self, palette: Palette) -> None:
        """Apply a palette."""
        self.points.colors = np.array(palette.picked, dtype=np.uint8)
        self._box.colors = np.array(palette.picked, dtype=np.uint8)

    def thicken(self, factor: float, text: float) -> None:
        """Multiply the line width of the box, and the size of the label by `text`."""
        self._box.thickness = factor * _THICKNESS
        self._label.font_screen_scale = text

    def set_point_size(self, metres: float) -> None:
        """Set the radius of the other points; picked ones are drawn larger."""
        self.points.point_size = _LARGER * metres


def label_text(cluster: ClusterResult) -> str:
    """What is written above a picked cluster."""
    return f"Cluster {cluster.index}: {cluster.label.name.lower()}"


def box_around(points: NDArray[np.float64]) -> NDArray[np.float32]:
    """Edges (12, 2, 3) of the axis-aligned bounding box of points (N, 3), N >= 1, with a margin."""
    return corners_around(points)[_EDGES].astype(np.float32)


def corners_around(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Corners (8, 3) of the axis-aligned bounding box of points (N, 3), N >= 1, with a margin."""
    low, high = points.min(axis=0) - _MARGIN, points.max(axis=0) + _MARGIN
    return box_corners(low, high)


def _mostly_seen(corners: NDArray[np.float64], camera: Camera) -> bool:
    """Whether at least half of a box's corners (8, 3) are about in a camera's picture."""
    rays = corners - camera.position
    depth = rays @ camera.direction
    aside = np.linalg.norm(rays - depth[:, None] * camera.direction, axis=1)
    return bool(np.count_nonzero(aside < _BESIDE * depth * np.tan(camera.fov / 2)) >= 4)


def _kept_below_top(
    place: NDArray[np.float64], up: NDArray[np.float64], camera: Camera
) -> NDArray[np.float64]:
    """A place (3,) moved down as far as a camera's picture needs it."""
    across = up - (up @ camera.direction) * camera.direction
    length = np.linalg.norm(across)
    if length < 1e-3:
        return place  # seen from straight above
    across, ray = across / length, place - camera.position
    highest = _TOP * np.tan(camera.fov / 2) * float(ray @ camera.direction)
    return place - max(float(ray @ across) - highest, 0.0) * across
