"""The two clouds and the arrows of the flow."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager

import numpy as np
import viser
from numpy.typing import NDArray

from app.scene.colours import Colour
from app.scene.palettes import Palette
from app.scene.scene_root import FIXED

SOURCE_NODE = f"{FIXED}/source"
TARGET_NODE = f"{FIXED}/target"
FLOW_NODE = f"{FIXED}/flow"
SECOND_FLOW_NODE = f"{FIXED}/second_flow"
TRUTH_NODE = f"{FIXED}/truth"
GHOST_NODE = f"{FIXED}/ghost"

_HEAD = 0.011  # maximum length of an arrow's head, as a fraction of the picture's height
_SHAFT, _TRUTH_SHAFT = 0.0013, 0.003  # radii of shafts, as fractions of the picture's height
_HEAD_WIDTH, _TRUTH_HEAD_WIDTH = 0.32, 0.5  # radii of heads, as fractions of their length
_NONE = np.zeros((0, 2, 3), dtype=np.float32)


class CloudsView:
    """Draws source, target, flow and truth of one pair."""

    def __init__(self, scene: viser.SceneApi, palette: Palette) -> None:
        self._target = _add_cloud(scene, TARGET_NODE)
        self._source = _add_cloud(scene, SOURCE_NODE)
        self._ghost = _add_cloud(scene, GHOST_NODE)
        self._all = (self._target, self._source, self._ghost)
        self._flow = scene.add_arrows(FLOW_NODE, _NONE, palette.flow)
        self._second_flow = scene.add_arrows(SECOND_FLOW_NODE, _NONE, palette.second)
        self._truth = scene.add_arrows(TRUTH_NODE, _NONE, palette.truth)
        self._height = 2.5
        self.paint(palette)

    def paint(self, palette: Palette) -> None:
        """Apply a palette to the nodes of a single colour."""
        self._target.colors = np.array(palette.target, dtype=np.uint8)
        self._ghost.colors = np.array(palette.ghost, dtype=np.uint8)
        self._truth.colors = np.array(palette.truth, dtype=np.uint8)

    def show_source(self, points: NDArray[np.float64], colours: NDArray[np.uint8]) -> None:
        """Draw the source (N, 3) in one colour (3,) or in a colour per point (N, 3)."""
        self._source.points = points.astype(np.float32)
        self._source.colors = colours

    def show_target(self, points: NDArray[np.float64]) -> None:
        """Draw the target (M, 3)."""
        self._target.points = points.astype(np.float32)

    def show_ghost(self, points: NDArray[np.float64]) -> None:
        """Draw the moving source points (N, 3) displaced by their true motion."""
        self._ghost.points = points.astype(np.float32)

    def show_flow(
        self,
        points: NDArray[np.float64],
        velocity: NDArray[np.float64],
        seconds: float,
        colours: NDArray[np.uint8],
    ) -> None:
        """Draw arrows whose length is the distance covered in `seconds`.

        Args:
            points: (N, 3) tails of the arrows, metres.
            velocity: (N, 3) m/s; rows of NaN have no arrow.
            seconds: above 0.
            colours: (N, 3).
        """
        drawn = has_arrow(points, velocity, seconds)
        self._draw(self._flow, arrows(points, velocity, seconds), _HEAD_WIDTH)
        self._flow.colors = colours[drawn]

    def show_second_flow(
        self,
        points: NDArray[np.float64],
        velocity: NDArray[np.float64],
        seconds: float,
        colour: Colour,
    ) -> None:
        """Draw a second flow in one colour; otherwise as `show_flow`."""
        self._draw(self._second_flow, arrows(points, velocity, seconds), _HEAD_WIDTH)
        self._second_flow.colors = np.array(colour, dtype=np.uint8)

    def show_truth(
        self, start: NDArray[np.float64], velocity: NDArray[np.float64] | None, seconds: float
    ) -> None:
        """Draw the moving object's true velocity (3,) from `start` (3,), or none."""
        if velocity is None:
            self._truth.points = _NONE
        else:
            arrow = arrows(start[None], velocity[None], seconds)
            self._draw(self._truth, arrow, _TRUTH_HEAD_WIDTH)

    @property
    def radius(self) -> float:
        """Radius of a point, metres."""
        return self._target.point_size

    def fit(self, height: float, point_size: float) -> None:
        """Scale points and arrows to the size of the picture.

        Args:
            height: of the picture at the distance of the look-at point, metres.
            point_size: diameter of a point, as a fraction of the picture's height.
        """
        self._height = height
        radius = point_size * height / 2
        self._source.point_size = self._target.point_size = radius
        self._ghost.point_size = 1.2 * radius
        self._flow.shaft_radius = self._second_flow.shaft_radius = _SHAFT * height
        self._truth.shaft_radius = _TRUTH_SHAFT * height
        for node in (self._flow, self._second_flow):
            _fit_head(node, _HEAD_WIDTH, _HEAD * height)
        _fit_head(self._truth, _TRUTH_HEAD_WIDTH, _HEAD * height)

    @contextmanager
    def clipped(
        self,
        eye: NDArray[np.float64],
        forward: NDArray[np.float64],
        near: float,
        others: Iterable[viser.PointCloudHandle],
    ) -> Iterator[None]:
        """Context without the points in front of a near plane; they come back afterwards.

        Args:
            eye: (3,) position of the camera, metres, in the fixed frame.
            forward: (3,) unit vector along its optical axis.
            near: distance of the plane from the camera, metres.
            others: further point clouds to clip.
        """
        kept = [(cloud, cloud.points, cloud.colors) for cloud in (*self._all, *others)]
        for cloud, points, colours in kept:
            drawn = (points - eye) @ forward > near
            cloud.points = points[drawn]
            if colours.ndim == 2:
                cloud.colors = colours[drawn]
        try:
            yield
        finally:
            for cloud, points, colours in kept:
                cloud.points, cloud.colors = points, colours

    def _draw(
        self, node: viser.ArrowsHandle, segments: NDArray[np.float64], head_width: float
    ) -> None:
        node.points = segments.astype(np.float32)
        _fit_head(node, head_width, _HEAD * self._height)


def arrows(
    points: NDArray[np.float64], velocity: NDArray[np.float64], seconds: float
) -> NDArray[np.float64]:
    """Tails and tips (A, 2, 3) of all arrows that are finite and longer than 0."""
    drawn = has_arrow(points, velocity, seconds)
    return np.stack([points[drawn], points[drawn] + seconds * velocity[drawn]], axis=1)


def has_arrow(
    points: NDArray[np.float64], velocity: NDArray[np.float64], seconds: float
) -> NDArray[np.bool_]:
    """Mask (N,) of the points whose arrow is finite and longer than 0."""
    long = np.linalg.norm(velocity * seconds, axis=1) > 1e-6
    return np.isfinite(points).all(axis=1) & long


def _add_cloud(scene: viser.SceneApi, name: str) -> viser.PointCloudHandle:
    return scene.add_point_cloud(
        name,
        np.zeros((0, 3)),
        (0, 0, 0),
        point_size=0.004,
        point_shape="circle",
        point_shading="flat",
        precision="float32",
    )


def _fit_head(node: viser.ArrowsHandle, width: float, longest: float) -> None:
    if len(node.points) > 0:
        # All heads are equally long: short enough for the shortest arrow to keep a shaft.
        shortest = float(np.linalg.norm(node.points[:, 1] - node.points[:, 0], axis=1).min())
        node.head_length = min(longest, 0.4 * shortest)
        node.head_radius = max(width * node.head_length, 1.6 * node.shaft_radius)
