"""Pictures of the scene, rendered by the browser that shows it."""

import numpy as np
import viser
import viser.transforms as vtf
from numpy.typing import NDArray

from app.analysis.pairs import Pair
from app.browser.script import canvas_size
from app.scene.first_view import View
from app.scene.scene import Scene

_TIMEOUT = 40.0  # seconds; a tab in the background never renders


class Photographer:
    """Takes pictures of a scene.

    Args:
        client: whose browser renders them.
        scene: that it shows.
    """

    def __init__(self, client: viser.ClientHandle, scene: Scene) -> None:
        self._client, self._scene = client, scene

    def size(self) -> tuple[int, int]:
        """Width and height of the scene in the page, CSS pixels."""
        return canvas_size(self._client)

    def take(self, pair: Pair, view: str | None, width: int, height: int) -> NDArray[np.uint8]:
        """Pixels (height, width, 4), transparent where nothing is.

        Args:
            pair: that the scene shows.
            view: name of the view, None for where the camera is.
            width: in pixels.
            height: in pixels.

        Raises:
            RuntimeError: the browser has gone.
            TimeoutError: it gives no picture, such as one whose tab is in the background.
        """
        camera = self._client.camera
        if view is None:
            placed = View(np.asarray(camera.position), np.asarray(camera.look_at))
            fov = float(camera.fov)
        else:
            placed, fov = self._scene.view(pair, view, width / height)
        # The page makes points as large as they have to be in its own window.
        larger = height / self.size()[1] * np.tan(camera.fov / 2) / np.tan(fov / 2)
        with self._scene.posed(placed, fov, larger, height):
            self._render(placed, fov, 8, 8)  # sizes are taken over one image later than the rest
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
    """Orientation (3, 3) of a camera, x right, y down, z forward, that is held upright."""
    forward = view.look_at - view.position
    forward = forward / np.linalg.norm(forward)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right = right / np.linalg.norm(right)
    return np.stack([right, np.cross(forward, right), forward], axis=1)
