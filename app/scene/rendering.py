"""Rendering of the scene to pictures, in the client's browser."""

import numpy as np
import viser
import viser.transforms as vtf
from numpy.typing import NDArray

from app.browser.script import canvas_size
from app.scene.camera import Camera
from app.scene.first_view import View
from app.scene.scene import Scene

_TIMEOUT = 40.0  # seconds; a tab in the background never renders


class SceneRenderer:
    """Renders a scene to pictures of any size and view.

    Args:
        client: whose browser renders.
        scene: drawn in that browser.
        timeout: seconds that a picture may take.
    """

    def __init__(self, client: viser.ClientHandle, scene: Scene, timeout: float = _TIMEOUT) -> None:
        self._client, self._scene, self._timeout = client, scene, timeout

    def size(self) -> tuple[int, int]:
        """Width and height of the scene in the page, CSS pixels."""
        return canvas_size(self._client)

    def render(self, camera: Camera, width: int, height: int, detail: float) -> NDArray[np.uint8]:
        """RGBA pixels (height, width, 4), transparent where nothing is drawn.

        Args:
            camera: of the picture.
            width: in pixels.
            height: in pixels.
            detail: pixels of what is one pixel wide in a picture 720 pixels high.

        Raises:
            RuntimeError: the browser has gone.
            TimeoutError: it returns no picture in time, as when its tab is in the background.
        """
        # The page sizes points for its own window and camera, not for the picture.
        slopes = np.tan(self._client.camera.fov / 2) / np.tan(camera.fov / 2)
        larger = height / self.size()[1] * float(slopes)
        with self._scene.picture_sizes(camera, larger, height, detail):
            self._render(camera, 8, 8)  # new sizes take effect one image late
            return self._render(camera, height, width)

    def _render(self, camera: Camera, height: int, width: int) -> NDArray[np.uint8]:
        placed = View(np.array(camera.position), np.array(camera.look_at))
        return self._client.get_render(
            height,
            width,
            wxyz=vtf.SO3.from_matrix(looking(placed)).wxyz,
            position=placed.position,
            fov=camera.fov,
            transport_format="png",
            timeout=self._timeout,
        )


def looking(view: View) -> NDArray[np.float64]:
    """Orientation (3, 3) of an upright camera: x right, y down, z forward."""
    forward = view.look_at - view.position
    forward = forward / np.linalg.norm(forward)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right = right / np.linalg.norm(right)
    return np.stack([right, np.cross(forward, right), forward], axis=1)
