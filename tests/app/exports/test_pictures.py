import io
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from app.errors import InputError
from app.exports.figure_layout import figure_layout
from app.exports.figure_notes import FigureNotes
from app.exports.figure_size import FigureSize
from app.exports.pictures import composed, png, view_pixels
from app.scene.camera import Camera
from app.scene.legend import Legend, LegendEntry, Ramp

WHITE = (255, 255, 255)
SIZE = FigureSize.in_pixels(600, 400)
CAMERA = Camera((3.0, -3.0, 2.0), (0.0, 0.0, 0.5), 0.6)
LEGEND = Legend(
    (LegendEntry((10, 20, 250), "Target"), LegendEntry((200, 30, 40), "Source")),
    Ramp(((0, 0, 0), (0, 240, 0)), "Flow: 0", "0.5 m/s"),
)
BARE = FigureNotes(None, (), False, False)


def picture(
    background=WHITE, notes=BARE, size=SIZE, views=1, colour=(0, 0, 0, 0)
) -> tuple[np.ndarray, tuple[int, int]]:
    """A figure of views of one colour, and the size of each view."""
    layout = figure_layout(size, views, notes.legend, notes.corner_line)
    width, height = view_pixels(size, layout)
    taken = [np.full((height, width, 4), colour, dtype=np.uint8)] * views
    drawn = composed(taken, size, layout, background, notes, [CAMERA] * views, np.eye(3))
    assert drawn.size == (size.width, size.height)
    return np.asarray(drawn), (width, height)


def test_a_transparent_background_becomes_white_or_stays():
    assert (picture()[0] == 255).all()
    clear, _ = picture(None)
    assert clear.shape[2] == 4
    assert (clear[..., 3] == 0).all()
    assert (picture(None, colour=(200, 30, 40, 255))[0] == [200, 30, 40, 255]).all()


def test_the_legend_and_the_corner_line_stand_below_the_view_in_their_colours():
    notes = replace(BARE, legend=LEGEND, corner_line=("a recording", "frame 24"))
    drawn, (_, height) = picture(notes=notes)
    assert height < 400
    assert (drawn[:height] == 255).all()
    below = drawn[height:]
    for entry in LEGEND.entries:
        assert (below == entry.colour).all(axis=2).sum() > 8
    greens = below[(below[..., 0] == 0) & (below[..., 2] == 0), 1]
    assert greens.min() == 0
    assert greens.max() > 230
    assert (below[-15:] < 100).any(), "there is no corner line"


def test_letters_can_be_read_on_every_background():
    notes = replace(BARE, legend=Legend((LegendEntry((10, 20, 250), "Target"),)))

    def letters(background, dark):
        drawn, (_, height) = picture(background, replace(notes, dark=dark, ground=background))
        return drawn[height:, 30:].astype(int)

    assert letters((20, 20, 20), dark=True)[..., :3].max() > 200
    assert letters(WHITE, dark=False).min() < 60
    for dark, ground in ((True, 28), (False, 255)):
        clear = letters(None, dark=dark)
        assert (clear[..., 0] == ground).mean() > 0.02, "there is no card behind them"
        assert (clear[..., 3] > 0).all()


def test_a_view_has_a_scale_bar_and_axes_inside_it():
    drawn, _ = picture(notes=replace(BARE, scale=True))
    dark = drawn.max(axis=2) < 90
    rows, columns = np.nonzero(dark)
    assert rows.min() > 300
    assert rows.max() < 398
    assert columns.min() > 2
    assert columns.max() < 598
    assert dark[:, :150].any(), "there are no axes"
    assert dark[:, 450:].any(), "there is no scale bar"


def test_the_file_says_what_it_shows_and_how_large_it_is_on_paper():
    said = {"Recording": "towards", "Parameters": '{"gamma": 0.7}', "Frame": "γ 24"}
    printed = FigureSize.in_millimetres(88, 62)
    for size, dpi in ((SIZE, None), (printed, 300)):
        image = Image.new("RGB", (size.width, size.height))
        read = Image.open(io.BytesIO(png(image, size, said)))
        assert read.size == (size.width, size.height)
        assert said.items() <= read.info.items()
        assert dpi is None or read.info["dpi"][0] == pytest.approx(dpi, rel=1e-3)
        assert ("dpi" in read.info) == (dpi is not None)


def test_views_stand_side_by_side_with_a_gap_and_letters():
    size = FigureSize.in_millimetres(88, 60)
    drawn, (width, height) = picture(size=size, views=2, colour=(200, 30, 40, 255))
    gap = size.width - 2 * width
    assert 10 < gap < 40
    assert (drawn[:, width : width + gap] == 255).all()
    assert (drawn[height // 2, :width] == [200, 30, 40]).all()
    assert (drawn[height // 2, width + gap :] == [200, 30, 40]).all()
    for left in (0, width + gap):
        corner = drawn[: height // 4, left : left + width // 3]
        assert (corner.max(axis=2) < 60).sum() > 50, "there is no letter"


def test_a_figure_without_room_for_its_texts_is_refused():
    with pytest.raises(InputError, match="no room for its legend and corner line"):
        figure_layout(FigureSize.in_pixels(64, 64), 1, LEGEND, ("a recording", "frame 24"))
