"""A picture of the scene as a PNG file in the browser's downloads."""

import io
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import viser
from numpy.typing import NDArray
from PIL import Image

from app.errors import InputError
from app.panel import Desk, Panel
from app.wishes import LatestWins

if TYPE_CHECKING:
    from app.workbench import Workbench

_TIMEOUT = 20.0  # seconds; a tab in the background never renders


@dataclass(frozen=True)
class TakeScreenshot(LatestWins):
    """Save what the page shows as a PNG file."""

    panel: "ScreenshotPanel"

    def fulfil(self, workbench: "Workbench") -> None:
        """Take it, where there is something to take."""
        if workbench.opened is not None:
            self.panel.take(workbench.opened.recording.name, workbench.frame)


class ScreenshotPanel(Panel):
    """A button that saves what the scene shows."""

    def __init__(self, desk: Desk) -> None:
        self._client = desk.client
        button = self._client.gui.add_button(
            "Save screenshot", icon=viser.Icon.CAMERA, hint="PNG of the scene"
        )

        @button.on_click
        def _(_: viser.GuiEvent) -> None:
            desk.post(TakeScreenshot(self))

    def take(self, recording: str, frame: int) -> None:
        """Render, and send the file to the browser; it is named after recording and frame.

        Raises:
            InputError: the browser gave no picture.
        """
        camera = self._client.camera
        try:
            pixels = self._client.get_render(
                camera.image_height, camera.image_width, transport_format="png", timeout=_TIMEOUT
            )
        except (RuntimeError, TimeoutError) as error:
            raise InputError(
                f"The browser gave no picture within {_TIMEOUT:.0f} s; "
                "bring its tab to the front and try again."
            ) from error
        self._client.send_file_download(
            file_name(recording, frame), on_white(pixels), save_immediately=True
        )


def file_name(recording: str, frame: int) -> str:
    """A name that every file system takes."""
    return f"{re.sub(r'[^A-Za-z0-9._-]+', '_', recording)}_frame_{frame:04d}.png"


def on_white(pixels: NDArray[np.uint8]) -> bytes:
    """PNG of an image (H, W, 4) whose transparent background becomes white."""
    picture = Image.fromarray(pixels)
    white = Image.new("RGBA", picture.size, "white")
    white.alpha_composite(picture.convert("RGBA"))
    data = io.BytesIO()
    white.convert("RGB").save(data, "PNG", optimize=True)
    return data.getvalue()
