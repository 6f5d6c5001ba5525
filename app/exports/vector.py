"""Vector file of the scene as PDF or SVG, made without a browser."""

import io
import json
from collections.abc import Mapping
from typing import Any

from app.exports.captions import caption
from app.exports.drawn_pair import DrawnPair
from app.exports.figure_notes import draw_notes, figure_sheet
from app.exports.figure_settings import FigureSettings
from app.exports.pinhole import Pinhole
from app.exports.solid import solid_of, true_object_of
from app.exports.vector_scene import VectorScene
from app.output.export_kinds import MADE_WITH
from app.scene.colours import css
from app.scene.scene_root import upright
from app.scene.settings import ViewSettings
from recordings import Recording

PDF, SVG = "pdf", "svg"


def vector_figure(
    recording: Recording,
    drawn: DrawnPair,
    settings: ViewSettings,
    figure: FigureSettings,
    kind: str,
) -> bytes:
    """Draw a pair as a vector file: points, arrows, frustums, the robot's outline, text as text.

    Args:
        recording: of the pair.
        drawn: the pair, and what is shown with it.
        settings: of the drawing.
        figure: of the file.
        kind: `PDF` or `SVG`.

    Raises:
        InputError: the figure is too small for its texts.
    """
    pair, size = drawn.pair, figure.size
    notes, layout = figure.planned(recording, drawn, settings)
    turn = upright(recording.fixed_frame)
    cameras = figure.cameras(recording, [pair], layout)
    scene = VectorScene(
        recording,
        drawn,
        settings,
        turn,
        solid_of(recording, pair, turn, settings.layers),
        true_object_of(recording, pair, turn, settings.layers),
        size.detail / size.pixels_per_point,
    )
    width, height = size.points
    with figure_sheet(size) as (sheet, axes):
        background = figure.background(settings)
        if background is not None:
            sheet.patch.set(visible=True, facecolor=css(background), edgecolor="none")
        for box, camera in zip(layout.views, cameras, strict=True):
            place = (
                box.left / width,
                1 - (box.top + box.height) / height,
                box.width / width,
                box.height / height,
            )
            view = sheet.add_axes(place, zorder=1)
            view.set_axis_off()
            view.set_autoscale_on(False)
            view.set_xlim(0, box.width)
            view.set_ylim(box.height, 0)
            scene.draw(view, Pinhole(camera, box.width, box.height))
        draw_notes(axes, layout, notes, cameras, turn)
        content = io.BytesIO()
        text = caption(recording, drawn.parameters, pair.frame, drawn.sides)
        sheet.savefig(content, format=kind, metadata=_metadata(kind, text), dpi=72)
    return content.getvalue()


def _metadata(kind: str, text: Mapping[str, str]) -> dict[str, Any]:
    """A file's own description of what it shows; without dates equal figures are equal files."""
    title = f"{text['Recording']}, frame {text['Frame']}"
    about = json.dumps(dict(text), ensure_ascii=False)
    if kind == PDF:
        return {
            "Title": title,
            "Creator": MADE_WITH,
            "Subject": about,
            "CreationDate": None,
            "Producer": None,
        }
    return {"Title": title, "Creator": [MADE_WITH], "Description": about, "Date": None}
