"""Placement of a session's camera, adapted when the window's aspect ratio changes."""

import numpy as np
import viser

from app.analysis.pairs import Pair
from app.scene.camera import Camera
from app.scene.drawn_flow import moving_ends
from app.scene.lens import aspect_of
from app.scene.scale_bar import ScaleBar, scale_bar
from app.scene.scene import Scene
from app.scene.views import SLANTED

Vector = tuple[float, float, float]

_UP: Vector = (0.0, 0.0, 1.0)
_SAME_SHAPE = 0.02  # relative change of the aspect ratio
_SEEN = 0.1  # share of what moves that a picture shows at least
_SAME_PLACE = 0.01  # relative to the distance of the look-at point


class Framing:
    """Moves the camera to named views.

    Docking or folding a panel changes the aspect ratio of the scene. The view is then computed
    again, unless the user has moved the camera since.

    Args:
        client: owner of the camera.
        scene: drawn in the client's browser.
    """

    def __init__(self, client: viser.ClientHandle, scene: Scene) -> None:
        self._client, self._scene = client, scene
        self._waiting: tuple[Camera, Vector] | None = None
        self._blank = False
        self._taken: tuple[str, float, Camera] | None = None

    @property
    def scale_bar(self) -> ScaleBar | None:
        """Scale bar of the page's camera, in parts of the scene's height instead of pixels."""
        return scale_bar(self._scene.camera(), aspect_of(self._client.camera), 1.0)

    @property
    def up(self) -> Vector:
        """What points up in the picture, (3,) in the drawing."""
        x, y, z = np.asarray(self._client.camera.up_direction).tolist()
        return x, y, z

    def start_from(self, camera: Camera, up: Vector | None = None) -> None:
        """Show the next recording from this camera, instead of from its first view.

        Args:
            camera: the pose.
            up: (3,) what points up in the picture, in the drawing; None for the z axis.
        """
        self._waiting = camera, up or _UP

    def begin(self, pair: Pair) -> None:
        """Move the camera to the first view of a newly opened recording."""
        waiting, self._waiting = self._waiting, None
        self._blank = waiting is None and len(pair.target.points) == 0
        if waiting:
            self.look(*waiting)
        else:
            self.set_view(pair, SLANTED)

    def set_view(self, pair: Pair, view: str) -> None:
        """Move the camera to the view of this name."""
        aspect = aspect_of(self._client.camera)
        self._client.camera.up_direction = _UP
        self._taken = (view, aspect, self._scene.place_camera(pair, view, aspect))

    def look(self, camera: Camera, up: Vector = _UP) -> None:
        """Move the camera to a pose of no named view.

        Args:
            camera: the pose.
            up: (3,) what points up in the picture, in the drawing's frame.
        """
        self._taken = None
        self._client.camera.up_direction = up
        self._scene.set_camera(camera)

    def misses(self, pair: Pair) -> bool:
        """Whether nearly all that moves in a pair, or else all points, are out of the picture."""
        moving, _ = moving_ends(pair)
        points = moving if len(moving) else pair.target.points
        if len(points) == 0:
            return False
        seen = self._scene.camera_in_fixed_frame().sees(
            points, self._scene.in_fixed_frame(np.array(self.up)), aspect_of(self._client.camera)
        )
        return float(seen.mean()) < _SEEN

    def retry_first_view(self, pair: Pair) -> None:
        """Compute the first view again if its frame was empty and this one has points."""
        if self._blank and len(pair.target.points):
            self.begin(pair)

    def adapt_to_window(self, pair: Pair) -> None:
        """Compute the view again if the aspect ratio has changed and the camera was not moved."""
        if self._taken is None:
            return
        view, aspect, placed = self._taken
        reshaped = abs(aspect_of(self._client.camera) / aspect - 1) > _SAME_SHAPE
        if reshaped and _same(placed, self._scene.camera()):
            self.set_view(pair, view)


def _same(one: Camera, other: Camera) -> bool:
    position, look_at = np.array(one.position), np.array(one.look_at)
    apart = np.linalg.norm(position - other.position) + np.linalg.norm(look_at - other.look_at)
    return bool(apart < _SAME_PLACE * np.linalg.norm(position - look_at))
