"""Picture of the scene as a PNG file, rendered without a user's browser."""

import threading
import time
from dataclasses import dataclass

import numpy as np
import viser
from numpy.typing import NDArray

from app.analysis.library import Opened
from app.analysis.pairs import Pair
from app.browser.guarded_server import GuardedServer
from app.browser.internals import FULL_RESOLUTION
from app.errors import InputError
from app.exports.captions import caption
from app.exports.chromium import headless_page
from app.exports.pictures import picture_file
from app.scene import theme
from app.scene.rendering import SceneRenderer
from app.scene.scene import Scene
from app.scene.settings import ViewSettings
from estimator import Parameters

_TIMEOUT = 120.0  # seconds until a picture must have been rendered


@dataclass(frozen=True)
class PictureSettings:
    """Size, views and background of a picture.

    Attributes:
        width: pixels of each view.
        height: pixels.
        views: names of `VIEWS`, placed side by side.
        transparent: whether the background is transparent.
        legend: whether a legend is drawn.
    """

    width: int
    height: int
    views: tuple[str, ...]
    transparent: bool = False
    legend: bool = False


def picture(
    opened: Opened,
    pair: Pair,
    parameters: Parameters,
    settings: ViewSettings,
    layout: PictureSettings,
) -> bytes:
    """Render a pair as PNG, as the app draws it, with its caption as PNG text.

    Args:
        opened: the recording.
        pair: of one of its frames, estimated.
        parameters: of the estimate.
        settings: of the drawing.
        layout: of the picture.

    Raises:
        InputError: Chromium is missing or returns no picture.
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
        # The page sizes points for its window, which is therefore as large as the picture.
        with headless_page(address, layout.width, layout.height):
            if not arrived.wait(_TIMEOUT):
                raise InputError(f"Chromium did not show the scene within {_TIMEOUT:.0f} s.")
            client = clients[0]
            with client.atomic():
                scene = Scene(client, settings)
                scene.open(opened.recording)
                scene.change(settings)
                scene.show(pair)
                scene.place_camera(pair, layout.views[0], layout.width / layout.height)
            renderer = SceneRenderer(client, scene)
            taken = [_settled(renderer, pair, view, layout) for view in layout.views]
            legend = scene.legend if layout.legend else None
    finally:
        server.stop()
    background = None if layout.transparent else theme.background(settings.dark)
    text = caption(opened.recording, parameters, pair.frame)
    return picture_file(taken, background, legend, text)


def _settled(
    renderer: SceneRenderer, pair: Pair, view: str, layout: PictureSettings
) -> NDArray[np.uint8]:
    """Render until two pictures (H, W, 4) in a row are equal."""
    end = time.monotonic() + _TIMEOUT
    before: NDArray[np.uint8] | None = None
    while time.monotonic() < end:
        try:
            pixels = renderer.render(pair, view, layout.width, layout.height)
        except (RuntimeError, TimeoutError) as error:
            raise InputError(
                f"Chromium gave no picture of {layout.width} x {layout.height} ({error}); "
                "try a smaller --size."
            ) from error
        if before is not None and pixels[..., 3].any() and np.array_equal(pixels, before):
            return pixels
        before = pixels
    raise InputError(f"Chromium gave no picture that keeps still within {_TIMEOUT:.0f} s.")
