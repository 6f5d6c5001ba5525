"""Screenshots of the scene as PNG downloads."""

from dataclasses import dataclass

import numpy as np
import viser
from numpy.typing import NDArray

from app.errors import InputError
from app.exports.captions import caption
from app.exports.file_names import safe
from app.exports.pictures import picture_file
from app.panels.panel import Panel, PanelContext
from app.scene import theme
from app.scene.legend import Legend
from app.scene.views import THREE_D, TOP
from app.session.command import LatestWins
from app.session.outbox import Download
from app.session.workbench import Workbench

_AS_SHOWN = "As on the screen"
_SIZES = {"1280 x 720": (1280, 720), "1600 x 900": (1600, 900), "1920 x 1080": (1920, 1080)}
_SCALES = {"1x": 1, "2x": 2, "3x": 3}
_WHITE, _TRANSPARENT = "White", "Transparent"
_BACKGROUNDS = (_AS_SHOWN, _WHITE, _TRANSPARENT)
_NO_PICTURE = (
    "The browser gave no picture; bring its tab to the front and try again, or choose a smaller "
    "size."
)


@dataclass(frozen=True)
class TakeScreenshot(LatestWins):
    """Save views as one PNG file, side by side.

    Attributes:
        views: their names; None for the view on the screen.
        size: width and height of each in pixels; None for the scene's on the screen.
        scale: factor of both.
        background: of the scene, one of `_BACKGROUNDS`.
        legend: whether a legend is drawn.
    """

    views: tuple[str | None, ...]
    size: tuple[int, int] | None
    scale: int
    background: str
    legend: bool

    def apply(self, workbench: Workbench) -> None:
        """Render the views, and put the file into the outbox.

        Raises:
            InputError: the browser returned no picture.
        """
        if workbench.opened is None:
            return
        recording, tuning = workbench.opened.recording, workbench.tuning
        background = {
            _WHITE: (255, 255, 255),
            _TRANSPARENT: None,
        }.get(self.background, theme.background(workbench.settings.dark))
        taken, legend = self._take(workbench)
        compared = tuning.comparison
        sides = compared.drawn(tuning.parameters) if compared else {}
        text = caption(recording, tuning.parameters, workbench.frame, sides)
        name = file_name(recording.name, workbench.frame, self.views)
        content = picture_file(taken, background, legend if self.legend else None, text)
        workbench.outbox.append(Download(name, content))

    def _take(self, workbench: Workbench) -> tuple[list[NDArray[np.uint8]], Legend]:
        """Render the pixels (H, W, 4) of each view, and return their legend, too."""
        dark = workbench.settings.dark
        try:
            if workbench.pair is None:
                raise InputError(_NO_PICTURE)
            width, height = self.size or workbench.renderer.size()
            size = (self.scale * width, self.scale * height)
            if self.background == _WHITE:
                # A dark page's colours are too pale on white.
                workbench.change_view({"dark": False})
            take = workbench.renderer.render
            return [
                take(workbench.pair, view, *size) for view in self.views
            ], workbench.scene.legend
        except (RuntimeError, TimeoutError) as error:
            raise InputError(_NO_PICTURE) from error
        finally:
            if self.background == _WHITE:
                workbench.change_view({"dark": dark})


class ScreenshotPanel(Panel):
    """Buttons that save the current view, or the 3D and top views."""

    def __init__(self, context: PanelContext) -> None:
        gui = context.client.gui
        shown = gui.add_button("Save screenshot", icon=viser.Icon.CAMERA, hint="PNG of the scene")
        both = gui.add_button(
            "Save 3D and top view",
            icon=viser.Icon.COLUMNS_2,
            color="gray",
            hint="Both views side by side in one PNG, as papers show them",
        )
        with gui.add_folder("Screenshot options", expand_by_default=False):
            size = gui.add_dropdown("Size", (_AS_SHOWN, *_SIZES), hint="Of one view, in pixels.")
            scale = gui.add_dropdown(
                "Scale", tuple(_SCALES), hint="Pixels for each pixel of the size, for print."
            )
            background = gui.add_dropdown("Background", _BACKGROUNDS)
            legend = gui.add_checkbox("With legend", True)

        def take(*views: str | None) -> None:
            context.post(
                TakeScreenshot(
                    views,
                    _SIZES.get(size.value),
                    _SCALES.get(scale.value, 1),
                    background.value,
                    legend.value,
                )
            )

        for button, views, icon in (
            (shown, (None,), viser.Icon.CAMERA),
            (both, (THREE_D, TOP), viser.Icon.COLUMNS_2),
        ):
            button.on_click(lambda _, views=views: take(*views))
            command = gui.add_command(button.label, icon=icon)
            command.on_trigger(lambda _, views=views: take(*views))


def file_name(recording: str, frame: int, views: tuple[str | None, ...] = (None,)) -> str:
    """File name that is safe on every file system."""
    names = "".join(f"_{safe(view).lower()}" for view in views if view)
    return f"{safe(recording)}_frame_{frame:04d}{names}.png"
