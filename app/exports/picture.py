"""Picture of the scene as a PNG file, rendered without a user's browser."""

from app.analysis.library import Opened
from app.exports.captions import caption
from app.exports.drawn_pair import DrawnPair
from app.exports.figure_settings import FigureSettings
from app.exports.headless import headless_scene
from app.exports.pictures import composed, png, view_pixels
from app.scene.scene_root import upright
from app.scene.settings import ViewSettings


def picture(
    opened: Opened,
    drawn: DrawnPair,
    settings: ViewSettings,
    figure: FigureSettings,
) -> bytes:
    """Render a pair as PNG, as the app draws it, with its caption as PNG text.

    Args:
        opened: the recording.
        drawn: pair of one of its frames, and what is shown with it.
        settings: of the drawing.
        figure: of the picture.

    Raises:
        InputError: the picture is too small for its texts, or Chromium is missing or returns none.
    """
    recording, size = opened.recording, figure.size
    notes, layout = figure.planned(recording, drawn, settings)
    width, height = view_pixels(size, layout)
    cameras = figure.cameras(recording, [drawn.pair], layout)
    with headless_scene(recording, settings, width, height, size.detail) as scene:
        scene.show(drawn)
        taken = [scene.settled(cameras[0]), *map(scene.rendered, cameras[1:])]
    background = figure.background(settings)
    image = composed(
        taken, size, layout, background, notes, cameras, upright(recording.fixed_frame)
    )
    return png(image, size, caption(recording, drawn.parameters, drawn.pair.frame, drawn.sides))
