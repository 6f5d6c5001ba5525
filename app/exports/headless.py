"""Scene of a recording in a headless Chromium, which renders pictures of it."""

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import viser
from numpy.typing import NDArray

from app.browser.guarded_server import GuardedServer
from app.browser.internals import FULL_RESOLUTION
from app.errors import InputError
from app.exports.chromium import headless_page
from app.exports.drawn_pair import DrawnPair
from app.scene.camera import Camera
from app.scene.legend import Legend
from app.scene.rendering import SceneRenderer
from app.scene.scene import Scene
from app.scene.settings import ViewSettings
from recordings import Recording

_TIMEOUT = 120.0  # seconds until a picture must have been rendered
_LARGEST_WINDOW = 480  # pixels of its sides; it draws by itself, too, the slower the larger it is


class HeadlessScene:
    """A scene in a headless browser.

    Args:
        client: the browser.
        scene: drawn in it.
        width: of its pictures, pixels.
        height: of its pictures, pixels.
        detail: pixels of what is one pixel wide in a picture 720 pixels high.
    """

    def __init__(
        self, client: viser.ClientHandle, scene: Scene, width: int, height: int, detail: float
    ) -> None:
        self._client, self._scene = client, scene
        self._renderer = SceneRenderer(client, scene, _TIMEOUT)
        self._width, self._height, self._detail = width, height, detail

    def show(self, drawn: DrawnPair) -> None:
        """Draw a pair of the recording."""
        with self._client.atomic():
            self._scene.show(drawn.pair, drawn.second, drawn.side, drawn.picked)

    @property
    def legend(self) -> Legend:
        """Legend of what is drawn."""
        return self._scene.legend

    def settled(self, camera: Camera) -> NDArray[np.uint8]:
        """Render until two pictures (H, W, 4) in a row are equal.

        Raises:
            InputError: there is no picture.
        """
        end = time.monotonic() + _TIMEOUT
        before: NDArray[np.uint8] | None = None
        while time.monotonic() < end:
            pixels = self.rendered(camera)
            if before is not None and pixels[..., 3].any() and np.array_equal(pixels, before):
                return pixels
            before = pixels
        raise InputError(f"Chromium gave no picture that keeps still within {_TIMEOUT:.0f} s.")

    def rendered(self, camera: Camera) -> NDArray[np.uint8]:
        """Render once, (H, W, 4); right as soon as one has `settled`.

        Raises:
            InputError: there is no picture.
        """
        try:
            return self._renderer.render(camera, self._width, self._height, self._detail)
        except (RuntimeError, TimeoutError) as error:
            raise InputError(
                f"Chromium gave no picture of {self._width} x {self._height} ({error}); "
                "try a smaller size, or again when the computer is less busy."
            ) from error


@contextmanager
def headless_scene(
    recording: Recording, settings: ViewSettings, width: int, height: int, detail: float
) -> Iterator[HeadlessScene]:
    """Context of a scene in a headless browser, in which no pair is drawn yet.

    Args:
        recording: to draw.
        settings: of the drawing.
        width: of the pictures, pixels.
        height: of the pictures, pixels.
        detail: pixels of what is one pixel wide in a picture 720 pixels high.

    Raises:
        InputError: Chromium is missing or does not start.
    """
    server = GuardedServer("127.0.0.1", 0)
    try:
        arrived = threading.Event()
        clients: list[viser.ClientHandle] = []

        @server.on_client_connect
        async def _(client: viser.ClientHandle) -> None:
            clients.append(client)
            arrived.set()

        address = f"http://127.0.0.1:{server.get_port()}/{FULL_RESOLUTION}"
        smaller = min(1.0, _LARGEST_WINDOW / max(width, height))
        window = (max(16, round(smaller * side)) for side in (width, height))
        with headless_page(address, *window):
            if not arrived.wait(_TIMEOUT):
                raise InputError(f"Chromium did not show the scene within {_TIMEOUT:.0f} s.")
            client = clients[0]
            with client.atomic():
                scene = Scene(client, settings)
                scene.open(recording)
                scene.change(settings)
            yield HeadlessScene(client, scene, width, height, detail)
    finally:
        server.stop()
