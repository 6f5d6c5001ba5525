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
from estimator import ClusterResult

PICKED_NODE = f"{FIXED}/picked"

_LARGER = 1.2  # radius of a picked point, relative to others that move
_THICKNESS = 1.0  # pixels, of the box's lines
_IN_VIEW = 0.6  # of half the field of view, within which the label is kept
_MARGIN = 0.015  # metres between the points and the box around them
_CORNERS = np.array(list(itertools.product((0, 1), repeat=3)))
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
        self._box.points = box_around(points)
        self._label.text = f"Cluster {cluster.index}: {cluster.label.name.lower()}"
        self._frame.visible = True

    def place_label(self, camera: Camera) -> None:
        """Put the label above what a camera, in the fixed frame, sees of the cluster."""
        if len(self._drawn) == 0:
            return
        rays = self._drawn - camera.position
        away = np.linalg.norm(np.cross(rays, camera.direction), axis=1)
        seen = away < (rays @ camera.direction) * np.tan(_IN_VIEW * camera.fov / 2)
        points = self._drawn[seen] if seen.any() else self._drawn
        middle = points.mean(axis=0)
        above = float(((points - middle) @ self._up).max()) + 2 * _MARGIN
        self._label.position = middle + above * self._up

    def paint(self, palette: Palette) -> None:
        """Apply a palette."""
        self.points.colors = np.array(palette.picked, dtype=np.uint8)
        self._box.colors = np.array(palette.picked, dtype=np.uint8)

    def thicken(self, factor: float) -> None:
        """Multiply the line width of the box."""
        self._box.thickness = factor * _THICKNESS

    def set_point_size(self, metres: float) -> None:
        """Set the radius of the other points; picked ones are drawn larger."""
        self.points.point_size = _LARGER * metres


def box_around(points: NDArray[np.float64]) -> NDArray[np.float32]:
    """Edges (12, 2, 3) of the axis-aligned bounding box of points (N, 3), N >= 1, with a margin."""
    low, high = points.min(axis=0) - _MARGIN, points.max(axis=0) + _MARGIN
    corners = low + _CORNERS * (high - low)
    return corners[_EDGES].astype(np.float32)
