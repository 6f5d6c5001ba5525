"""Rendering of the scene to pictures, in the client's browser."""

import numpy as np
import viser
import viser.transforms as vtf
from numpy.typing import NDArray

from app.analysis.pairs import Pair
from app.browser.script import canvas_size
from app.scene.first_view import View
from app.scene.scene import Scene

_TIMEOUT = 40.0  # seconds; a tab in the background never renders


class SceneRenderer:
    """Renders a scene to pictures of any size and view.

    Args:
        client: whose browser renders.
        scene: drawn in that browser.
    """

    def __init__(self, client: viser.ClientHandle, scene: Scene) -> None:
        self._client, self._scene = client, scene

    def size(self) -> tuple[int, int]:
        """Width and height of the scene in the page, CSS pixels."""
        return canvas_size(self._client)

    def render(self, pair: Pair, view: str | None, width: int, height: int) -> NDArray[np.uint8]:
        """RGBA pixels (height, width, 4), transparent where nothing is drawn.

        Args:
            pair: drawn in the scene.
            view: name of the view, None for the current camera.
            width: in pixels.
            height: in pixels.

        Raises:
            RuntimeError: the browser has gone.
            TimeoutError: it returns no picture in time, as when its tab is in the background.
        """
        camera = self._client.camera
        if view is None:
            placed = View(np.asarray(camera.position), np.asarray(camera.look_at))
            fov = float(camera.fov)
        else:
            placed, fov = self._scene.view(pair, view, width / height)
        # The page sizes points for its own window, not for the picture.
        larger = height / self.size()[1] * np.tan(camera.fov / 2) / np.tan(fov / 2)
        with self._scene.picture_sizes(placed, fov, larger, height):
            self._render(placed, fov, 8, 8)  # new sizes take effect one image late
            return self._render(placed, fov, height, width)

    def _render(self, placed: View, fov: float, height: int, width: int) -> NDArray[np.uint8]:
        return self._client.get_render(
            height,
            width,
            wxyz=vtf.SO3.from_matrix(looking(placed)).wxyz,
            position=placed.position,
            fov=fov,
            transport_format="png",
            timeout=_TIMEOUT,
        )


def looking(view: View) -> NDArray[np.float64]:
    """Orientation (3, 3) of an upright camera: x right, y down, z forward."""
    forward = view.look_at - view.position
    forward = forward / np.linalg.norm(forward)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right = right / np.linalg.norm(right)
    return np.stack([right, np.cross(forward, right), forward], axis=1)
