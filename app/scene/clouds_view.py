"""The two clouds and the arrows of the flow."""

import numpy as np
import viser
from numpy.typing import NDArray

from app.colours import FLOW, SOURCE, TARGET, TRUTH
from app.scene.stage import FIXED

SOURCE_NODE = f"{FIXED}/source"
TARGET_NODE = f"{FIXED}/target"
FLOW_NODE = f"{FIXED}/flow"
TRUTH_NODE = f"{FIXED}/truth"

_HEAD = 0.03  # metres, an arrow's head at most
_NONE = np.zeros((0, 2, 3), dtype=np.float32)


class CloudsView:
    """Draws source, target, flow and truth of one pair."""

    def __init__(self, scene: viser.SceneApi, point_size: float) -> None:
        empty = np.zeros((0, 3))
        self._target = scene.add_point_cloud(
            TARGET_NODE,
            empty,
            TARGET,
            point_size=point_size,
            point_shape="circle",
            point_shading="flat",
            precision="float32",
        )
        self._source = scene.add_point_cloud(
            SOURCE_NODE,
            empty,
            SOURCE,
            point_size=point_size,
            point_shape="circle",
            point_shading="flat",
            precision="float32",
        )
        self._flow = scene.add_arrows(FLOW_NODE, _NONE, FLOW, shaft_radius=0.003)
        self._truth = scene.add_arrows(TRUTH_NODE, _NONE, TRUTH, shaft_radius=0.008)

    def show_source(self, points: NDArray[np.float64]) -> None:
        """Draw the source (N, 3)."""
        self._source.points = points.astype(np.float32)

    def show_target(self, points: NDArray[np.float64]) -> None:
        """Draw the target (M, 3)."""
        self._target.points = points.astype(np.float32)

    def show_flow(
        self, points: NDArray[np.float64], velocity: NDArray[np.float64], seconds: float
    ) -> None:
        """Draw arrows as long as the way that is gone in `seconds`.

        Args:
            points: (N, 3) where they start.
            velocity: (N, 3) m/s; rows of NaN have no arrow.
            seconds: above 0.
        """
        _draw(self._flow, arrows(points, velocity, seconds), head_width=0.32)

    def show_truth(
        self, start: NDArray[np.float64], velocity: NDArray[np.float64] | None, seconds: float
    ) -> None:
        """Draw the moving object's true velocity (3,) from `start` (3,), or nothing for None."""
        if velocity is None:
            self._truth.points = _NONE
        else:
            _draw(self._truth, arrows(start[None], velocity[None], seconds), head_width=0.5)

    def set_point_size(self, metres: float) -> None:
        """Draw points with this radius."""
        self._source.point_size = self._target.point_size = metres


def arrows(
    points: NDArray[np.float64], velocity: NDArray[np.float64], seconds: float
) -> NDArray[np.float64]:
    """Starts and ends (A, 2, 3) of the arrows that can be drawn: finite, and not of length 0."""
    way = velocity * seconds
    drawn = np.isfinite(points).all(axis=1) & (np.linalg.norm(way, axis=1) > 1e-6)
    return np.stack([points[drawn], points[drawn] + way[drawn]], axis=1)


def _draw(node: viser.ArrowsHandle, segments: NDArray[np.float64], *, head_width: float) -> None:
    if len(segments) > 0:
        # All heads are equally long: short enough for the shortest arrow to keep a shaft.
        shortest = float(np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1).min())
        node.head_length = min(_HEAD, 0.4 * shortest)
        node.head_radius = max(head_width * node.head_length, 1.6 * node.shaft_radius)
    node.points = segments.astype(np.float32)
