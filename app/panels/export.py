"""Export of what is drawn: pictures, vector drawings, videos, and the flow as numbers."""

from collections.abc import Callable, Mapping
from typing import TypeVar

import viser

from app.exports.flow_file import CSV, NPZ
from app.exports.images import ZIP
from app.exports.vector import PDF, SVG
from app.exports.video import GIF, MP4
from app.panels.figure_controls import FigureControls
from app.panels.figure_exports import SavePicture, SaveVector, SaveVideo
from app.panels.flow_export import SaveFlow
from app.panels.panel import Panel, PanelContext
from app.panels.triggers import post_chosen
from app.session.command import Command

T = TypeVar("T")

_VECTORS = {"PDF": PDF, "SVG": SVG}
_VIDEOS = {"MP4": MP4, "GIF": GIF, "PNGs": ZIP}
_FLOWS = {"CSV": CSV, "NPZ": NPZ}


class ExportPanel(Panel):
    """Settings of a figure, and buttons for what is made of it."""

    def __init__(self, context: PanelContext) -> None:
        self._gui, self._post = context.client.gui, context.post
        picture = self._gui.add_button(
            "Save screenshot",
            icon=viser.Icon.CAMERA,
            hint="PNG of the scene, with what is chosen below",
        )
        palette = self._gui.add_command("Save screenshot", icon=viser.Icon.CAMERA)
        self._add_group(
            "Vector",
            _VECTORS,
            lambda kind: SaveVector(self._controls.chosen(), kind),
            "The same as a drawing for print, whose text stays text",
        )
        self._add_group(
            "Video",
            _VIDEOS,
            lambda kind: SaveVideo(self._controls.chosen(), kind),
            "Frames of the range that is played, at its speed, or in a ZIP file; by the server's "
            "Chromium",
        )
        self._add_group(
            "Flow data",
            _FLOWS,
            lambda kind: SaveFlow(kind, whole=False),
            "x y z, vx vy vz, label, cluster, sensor and zone of every source point of this frame",
        )
        self._add_group(
            "Flow of range",
            _FLOWS,
            lambda kind: SaveFlow(kind, whole=True),
            "The same of all frames of the range that is played",
        )
        self._controls = FigureControls(self._gui)

        async def save(_: viser.GuiEvent | viser.CommandEvent) -> None:
            self._post(SavePicture(self._controls.chosen()))

        picture.on_click(save)
        palette.on_trigger(save)

    def _add_group(
        self, label: str, options: Mapping[str, T], command: Callable[[T], Command], hint: str
    ) -> None:
        group = self._gui.add_button_group(label, tuple(options), hint=hint)

        @group.on_click
        async def _(_: viser.GuiEvent) -> None:
            post_chosen(self._post, group, options, command)
