"""The two clouds and the arrows of the flow."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager

import numpy as np
import viser
from numpy.typing import NDArray

from app.scene.arrows import Arrows
from app.scene.colours import Colour
from app.scene.drawn_flow import DrawnFlow
from app.scene.scene_root import FIXED

SOURCE_NODE = f"{FIXED}/source"
TARGET_NODE = f"{FIXED}/target"
STATIC_SOURCE_NODE = f"{FIXED}/static_source"
STATIC_TARGET_NODE = f"{FIXED}/static_target"
FLOW_NODE = f"{FIXED}/flow"
SECOND_FLOW_NODE = f"{FIXED}/second_flow"
TRUTH_NODE = f"{FIXED}/truth"

HEAD, TRUTH_HEAD = 0.011, 0.022  # length of an arrow's head, of the picture's height
SHAFT, TRUTH_SHAFT = 0.0024, 0.005  # thickness of shafts, of the picture's height

_NO_COLOURS = np.zeros(3, dtype=np.uint8)  # of an empty cloud; the page takes no empty list


class Cloud:
    """A cloud in two nodes: the points that stand out, and the others.

    Args:
        scene: to draw in.
        node: of the points that stand out.
        static_node: of the others.
    """

    def __init__(self, scene: viser.SceneApi, node: str, static_node: str) -> None:
        self._static = _add_cloud(scene, static_node)
        self._moving = _add_cloud(scene, node)

    @property
    def nodes(self) -> tuple[viser.PointCloudHandle, viser.PointCloudHandle]:
        """Both nodes."""
        return self._static, self._moving

    @property
    def radius(self) -> float:
        """Radius of a point that stands out, metres."""
        return self._moving.point_size

    def show(
        self,
        points: NDArray[np.float64],
        colours: NDArray[np.uint8],
        moving: NDArray[np.bool_],
    ) -> None:
        """Draw points (N, 3) in colours (N, 3); a mask (N,) says which stand out."""
        _show(self._moving, points[moving], colours[moving])
        _show(self._static, points[~moving], colours[~moving])

    def fit(self, radius: float, static_part: float) -> None:
        """Set the radius of points that stand out in metres, and the others' as a part of it."""
        self._moving.point_size = radius
        self._static.point_size = static_part * radius


class CloudsView:
    """Draws source, target, flow and truth of one pair.

    Attributes:
        source: P_{k-n}.
        target: P_k.
    """

    def __init__(self, scene: viser.SceneApi) -> None:
        self.target = Cloud(scene, TARGET_NODE, STATIC_TARGET_NODE)
        self.source = Cloud(scene, SOURCE_NODE, STATIC_SOURCE_NODE)
        self._all = (*self.target.nodes, *self.source.nodes)
        self._flow = Arrows(scene, FLOW_NODE)
        self._second_flow = Arrows(scene, SECOND_FLOW_NODE)
        self._truth = Arrows(scene, TRUTH_NODE)
        self._static_size = 1.0

    def show_flow(self, flow: DrawnFlow) -> None:
        """Draw the arrows of a flow."""
        _show_arrows(self._flow, flow)

    def show_second_flow(self, flow: DrawnFlow) -> None:
        """Draw the arrows of a second flow beside it."""
        _show_arrows(self._second_flow, flow)

    def show_truth(
        self,
        start: NDArray[np.float64],
        displacement: NDArray[np.float64] | None,
        colour: Colour,
    ) -> None:
        """Draw the moving object's true displacement (3,) from `start` (3,), or none."""
        shown = np.zeros((0, 3)) if displacement is None else displacement[None]
        segments = arrows(start[None][: len(shown)], shown)
        self._truth.show(segments, np.array(colour, dtype=np.uint8))

    @property
    def radius(self) -> float:
        """Radius of a point that moves, metres."""
        return self.source.radius

    def fit(self, height: float, point_size: float) -> None:
        """Scale points and arrows to the size of the picture.

        Args:
            height: of the picture at the distance of the look-at point, metres.
            point_size: diameter of a point that moves, as a fraction of the picture's height.
        """
        radius = point_size * height / 2
        self._size(radius)
        for flow in (self._flow, self._second_flow):
            flow.fit(SHAFT * height, HEAD * height, gap=radius)
        self._truth.fit(TRUTH_SHAFT * height, TRUTH_HEAD * height, gap=0.0)

    def size_static(self, part: float) -> None:
        """Set the size of points that do not move, as a part of the others'."""
        if part != self._static_size:
            self._static_size = part
            self._size(self.radius)

    def _size(self, radius: float) -> None:
        for cloud in (self.source, self.target):
            cloud.fit(radius, self._static_size)

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
                cloud.colors = _sendable(colours[drawn])
        try:
            yield
        finally:
            for cloud, points, colours in kept:
                cloud.points, cloud.colors = points, colours


def arrows(points: NDArray[np.float64], displacement: NDArray[np.float64]) -> NDArray[np.float64]:
    """Beginnings and ends (A, 2, 3) of all arrows that are finite and longer than 0."""
    drawn = has_arrow(points, displacement)
    return np.stack([points[drawn], points[drawn] + displacement[drawn]], axis=1)


def has_arrow(points: NDArray[np.float64], displacement: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Mask (N,) of the points whose arrow is finite and longer than 0."""
    return np.isfinite(points).all(axis=1) & (np.linalg.norm(displacement, axis=1) > 1e-6)


def _show_arrows(node: Arrows, flow: DrawnFlow) -> None:
    drawn = has_arrow(flow.points, flow.displacement)
    node.show(arrows(flow.points, flow.displacement), flow.colours[drawn])


def _show(
    cloud: viser.PointCloudHandle, points: NDArray[np.float64], colours: NDArray[np.uint8]
) -> None:
    drawn, painted = points.astype(np.float32), _sendable(colours)
    if not np.array_equal(cloud.points, drawn):
        cloud.points = drawn
    if not np.array_equal(cloud.colors, painted):
        cloud.colors = painted


def _sendable(colours: NDArray[np.uint8]) -> NDArray[np.uint8]:
    return colours if len(colours) else _NO_COLOURS


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
