"""Picture of the scene as a PNG file, rendered without a user's browser."""

from app.analysis.library import Opened
from app.analysis.pairs import Pair
from app.exports.captions import caption
from app.exports.figure_settings import FigureSettings
from app.exports.headless import headless_scene
from app.exports.pictures import composed, png, view_pixels
from app.scene.scene_root import upright
from app.scene.settings import ViewSettings
from estimator import Parameters


def picture(
    opened: Opened,
    pair: Pair,
    parameters: Parameters,
    settings: ViewSettings,
    figure: FigureSettings,
) -> bytes:
    """Render a pair as PNG, as the app draws it, with its caption as PNG text.

    Args:
        opened: the recording.
        pair: of one of its frames, estimated.
        parameters: of the estimate.
        settings: of the drawing.
        figure: of the picture.

    Raises:
        InputError: the picture is too small for its texts, or Chromium is missing or returns none.
    """
    recording, size = opened.recording, figure.size
    notes, layout = figure.planned(recording, pair, parameters, settings)
    width, height = view_pixels(size, layout)
    cameras = figure.cameras(recording, [pair], layout)
    with headless_scene(recording, settings, width, height, size.detail) as scene:
        scene.show(pair)
        taken = [scene.settled(cameras[0]), *map(scene.rendered, cameras[1:])]
    background = figure.background(settings)
    image = composed(
        taken, size, layout, background, notes, cameras, upright(recording.fixed_frame)
    )
    return png(image, size, caption(recording, parameters, pair.frame))
