"""Pictures of the scene, rendered by the browser that shows it."""

import numpy as np
import viser
import viser.transforms as vtf
from numpy.typing import NDArray

from app.analysis.estimates import Pair
from app.browser.script import canvas_size
from app.scene.first_view import View
from app.scene.scene import Scene

_TIMEOUT = 40.0  # seconds; a tab in the background never renders


def photograph(
    client: viser.ClientHandle,
    scene: Scene,
    pair: Pair,
    view: str | None,
    width: int,
    height: int,
) -> NDArray[np.uint8]:
    """Pixels (height, width, 4), transparent where nothing is.

    Args:
        client: whose browser renders it.
        scene: what is to be seen.
        pair: that the scene shows.
        view: name of the view, None for where the camera is.
        width: in pixels.
        height: in pixels.

    Raises:
        RuntimeError: the browser has gone.
        TimeoutError: it gives no picture.
    """
    camera = client.camera
    if view is None:
        placed = View(np.asarray(camera.position), np.asarray(camera.look_at))
        fov = float(camera.fov)
    else:
        placed, fov = scene.view(pair, view, width / height)
    wxyz = vtf.SO3.from_matrix(looking(placed)).wxyz
    # The page makes points as large as they have to be in its own window.
    larger = height / canvas_size(client)[1] * np.tan(camera.fov / 2) / np.tan(fov / 2)

    def render(height: int, width: int) -> NDArray[np.uint8]:
        return client.get_render(
            height,
            width,
            wxyz=wxyz,
            position=placed.position,
            fov=fov,
            transport_format="png",
            timeout=_TIMEOUT,
        )

    with scene.posed(placed, fov, larger, height):
        render(8, 8)  # sizes are taken over one image later than everything else
        return render(height, width)


def looking(view: View) -> NDArray[np.float64]:
    """Orientation (3, 3) of a camera, x right, y down, z forward, that is held upright."""
    forward = view.look_at - view.position
    forward = forward / np.linalg.norm(forward)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right = right / np.linalg.norm(right)
    return np.stack([right, np.cross(forward, right), forward], axis=1)
