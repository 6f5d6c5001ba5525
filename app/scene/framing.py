"""Where a session's camera is put, and how it is kept there while the window changes its shape."""

import numpy as np
import viser

from app.analysis.pairs import Pair
from app.scene.camera import Camera
from app.scene.lens import aspect_of
from app.scene.scene import Scene
from app.scene.views import THREE_D

_SAME_SHAPE = 0.02  # of the aspect
_SAME_PLACE = 0.01  # of the distance to what is looked at


class Framing:
    """Puts the camera to views by their names.

    Panels that are docked or folded change the shape of the picture. A view is then taken anew,
    unless a person has moved the camera since.

    Args:
        client: whose camera it is.
        scene: what is seen.
    """

    def __init__(self, client: viser.ClientHandle, scene: Scene) -> None:
        self._client, self._scene = client, scene
        self._waiting: Camera | None = None
        self._blank = False
        self._taken: tuple[str, float, Camera] | None = None

    def stand(self, camera: Camera) -> None:
        """Let the next recording that is drawn be seen from there, instead of its first view."""
        self._waiting = camera

    def begin(self, pair: Pair) -> None:
        """Put the camera to the first view of a recording."""
        waiting, self._waiting = self._waiting, None
        self._blank = waiting is None and len(pair.target.points) == 0
        if waiting:
            self._taken = None
            self._scene.stand(waiting)
        else:
            self.look(pair, THREE_D)

    def look(self, pair: Pair, view: str) -> None:
        """Put the camera to the view of this name."""
        aspect = aspect_of(self._client.camera)
        self._taken = (view, aspect, self._scene.place_camera(pair, view, aspect))

    def seen(self, pair: Pair) -> None:
        """Take the first view anew, now that there is something to see, where there was nothing."""
        if self._blank and len(pair.target.points):
            self.begin(pair)

    def follow(self, pair: Pair) -> None:
        """Take the view anew where the picture has another shape than when it was taken."""
        if self._taken is None:
            return
        view, aspect, placed = self._taken
        reshaped = abs(aspect_of(self._client.camera) / aspect - 1) > _SAME_SHAPE
        if reshaped and _same(placed, self._scene.camera()):
            self.look(pair, view)


def _same(one: Camera, other: Camera) -> bool:
    position, look_at = np.array(one.position), np.array(one.look_at)
    apart = np.linalg.norm(position - other.position) + np.linalg.norm(look_at - other.look_at)
    return bool(apart < _SAME_PLACE * np.linalg.norm(position - look_at))
