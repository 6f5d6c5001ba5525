"""Composition of rendered views into PNG pictures, with everything that is written beside them."""

import io
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from app.exports.figure_layout import FigureLayout
from app.exports.figure_notes import FigureNotes, draw_notes, figure_sheet
from app.exports.figure_size import FigureSize
from app.scene.camera import Camera
from app.scene.colours import Colour

SOFTWARE = "Tofscope"
"""Name in the files, by which they are known as Tofscope's."""


def composed(
    views: Sequence[NDArray[np.uint8]],
    size: FigureSize,
    layout: FigureLayout,
    background: Colour | None,
    notes: FigureNotes,
    cameras: Sequence[Camera],
    R_drawing_fixed: NDArray[np.float64],
) -> Image.Image:
    """Compose rendered views with their background and all notes.

    Args:
        views: pixels (H, W, 4) of each, transparent where nothing is drawn.
        size: of the figure.
        layout: of the figure; each view has the size of its box.
        background: colour, None to keep it transparent.
        notes: what is written and drawn beside the scene.
        cameras: of each view.
        R_drawing_fixed: (3, 3) from the fixed frame into the drawing's.
    """
    ground = (*background, 255) if background is not None else (0, 0, 0, 0)
    picture = Image.new("RGBA", (size.width, size.height), ground)
    for pixels, box in zip(views, layout.views, strict=True):
        left, top = (round(at * size.pixels_per_point) for at in (box.left, box.top))
        picture.alpha_composite(Image.fromarray(pixels).convert("RGBA"), (left, top))
    picture.alpha_composite(_notes_image(size, layout, notes, cameras, R_drawing_fixed))
    return picture if background is None else picture.convert("RGB")


def png(picture: Image.Image, size: FigureSize, caption: Mapping[str, str]) -> bytes:
    """PNG file with its resolution, and the caption {name: value} as its text."""
    info = PngInfo()
    for name, value in {"Software": SOFTWARE, **caption}.items():
        info.add_text(name, value)
    data = io.BytesIO()
    resolution = {"dpi": (size.dpi, size.dpi)} if size.printed else {}
    picture.save(data, "PNG", pnginfo=info, **resolution)
    return data.getvalue()


def view_pixels(size: FigureSize, layout: FigureLayout) -> tuple[int, int]:
    """Width and height in pixels of each view of a figure."""
    box = layout.views[0]
    width, height = box.width * size.pixels_per_point, box.height * size.pixels_per_point
    return round(width), round(height)


def _notes_image(
    size: FigureSize,
    layout: FigureLayout,
    notes: FigureNotes,
    cameras: Sequence[Camera],
    R_drawing_fixed: NDArray[np.float64],
) -> Image.Image:
    """Everything beside the scene, on a transparent ground."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    with figure_sheet(size) as (figure, axes):
        draw_notes(axes, layout, notes, tuple(cameras), R_drawing_fixed)
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
        return Image.fromarray(np.asarray(canvas.buffer_rgba()))
