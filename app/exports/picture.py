"""A picture of the scene as a PNG file, with no one at a browser."""

import threading
import time
from dataclasses import dataclass

import numpy as np
import viser
from numpy.typing import NDArray

from app.analysis.library import Opened
from app.analysis.pairs import Pair
from app.browser.guarded_server import GuardedServer
from app.errors import InputError
from app.exports.captions import caption
from app.exports.chromium import headless_page
from app.exports.pictures import composed, png, side_by_side
from app.scene import theme
from app.scene.rendering import SceneRenderer
from app.scene.scene import Scene
from app.scene.settings import ViewSettings
from estimator import Parameters

_TIMEOUT = 120.0  # seconds until a picture must be there


@dataclass(frozen=True)
class PictureSettings:
    """What a picture takes in.

    Attributes:
        width: pixels of each view.
        height: pixels.
        views: where the camera stands, of `VIEWS`; they stand side by side.
        transparent: whether there is no background.
        legend: whether it says what the colours mean.
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
    framing: PictureSettings,
) -> bytes:
    """PNG of a pair as the app draws it; what it shows is in the file's text.

    Args:
        opened: the recording.
        pair: of one of its frames, estimated.
        parameters: of the estimate.
        settings: of the drawing.
        framing: of the picture.

    Raises:
        InputError: there is no Chromium, or it gives no picture.
    """
    server = GuardedServer("127.0.0.1", 0)
    try:
        arrived = threading.Event()
        clients: list[viser.ClientHandle] = []

        @server.on_client_connect
        async def _(client: viser.ClientHandle) -> None:
            clients.append(client)
            arrived.set()

        address = f"http://127.0.0.1:{server.get_port()}"
        # The size of points follows the window, which is why it is as large as the picture.
        with headless_page(address, framing.width, framing.height):
            if not arrived.wait(_TIMEOUT):
                raise InputError(f"Chromium did not show the scene within {_TIMEOUT:.0f} s.")
            client = clients[0]
            with client.atomic():
                scene = Scene(client, settings)
                scene.open(opened.recording)
                scene.change(settings)
                scene.show(pair)
                scene.place_camera(pair, framing.views[0], framing.width / framing.height)
            renderer = SceneRenderer(client, scene)
            taken = [_settled(renderer, pair, view, framing) for view in framing.views]
            legend = scene.legend if framing.legend else None
    finally:
        server.stop()
    background = None if framing.transparent else theme.background(settings.dark)
    legends = [legend] + [None] * len(taken)
    pictures = [
        composed(pixels, background, legend) for pixels, legend in zip(taken, legends, strict=False)
    ]
    return png(side_by_side(pictures), caption(opened.recording, parameters, pair.frame))


def _settled(
    renderer: SceneRenderer, pair: Pair, view: str, framing: PictureSettings
) -> NDArray[np.uint8]:
    """The picture (H, W, 4), once it does not change any more."""
    end = time.monotonic() + _TIMEOUT
    before: NDArray[np.uint8] | None = None
    while time.monotonic() < end:
        try:
            pixels = renderer.render(pair, view, framing.width, framing.height)
        except (RuntimeError, TimeoutError) as error:
            raise InputError(
                f"Chromium gave no picture of {framing.width} x {framing.height} ({error}); "
                "try a smaller --size."
            ) from error
        if before is not None and pixels[..., 3].any() and np.array_equal(pixels, before):
            return pixels
        before = pixels
    raise InputError(f"Chromium gave no picture that keeps still within {_TIMEOUT:.0f} s.")
