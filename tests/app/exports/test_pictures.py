import io

import numpy as np
from PIL import Image

from app.exports.pictures import composed, png, side_by_side
from app.scene.legend import Legend, LegendEntry, Ramp

WHITE = (255, 255, 255)


def pixels(height=200, width=300):
    """Red to the left, nothing to the right."""
    drawn = np.zeros((height, width, 4), dtype=np.uint8)
    drawn[:, : width // 2] = [200, 30, 40, 255]
    return drawn


def test_a_transparent_background_becomes_white_or_stays():
    white = np.asarray(composed(pixels(), WHITE, None))
    assert white.shape == (200, 300, 3)
    assert (white[:, :150] == [200, 30, 40]).all()
    assert (white[:, 150:] == 255).all()
    clear = np.asarray(composed(pixels(), None, None))
    assert (clear[:, 150:, 3] == 0).all()


def test_the_legend_is_drawn_in_its_colours_in_the_lower_left_corner():
    nothing = np.zeros((400, 600, 4), dtype=np.uint8)
    legend = Legend(
        (LegendEntry((10, 20, 250), "Target"),),
        Ramp(((0, 0, 0), (0, 240, 0)), "Flow: 0", "0.5 m/s"),
    )
    drawn = np.asarray(composed(nothing, WHITE, legend))
    assert (drawn[:320] == 255).all()
    assert (drawn[:, 400:] == 255).all()
    rows, columns = np.nonzero((drawn == [10, 20, 250]).all(axis=2))
    assert len(rows) > 20
    assert columns.max() < 30
    greens = drawn[(drawn[..., 0] == 0) & (drawn[..., 2] == 0), 1]
    assert greens.min() == 0
    assert greens.max() == 240


def test_the_legends_letters_can_be_read_on_every_background():
    nothing = np.zeros((400, 600, 4), dtype=np.uint8)

    def letters(background, dark):
        legend = Legend((LegendEntry((10, 20, 250), "Target"),), dark=dark)
        drawn = np.asarray(composed(nothing, background, legend)).astype(int)
        return drawn[320:, 30:200, :3]

    assert letters((20, 20, 20), dark=False).max() > 200
    assert letters(WHITE, dark=True).min() < 60
    for dark, ground in ((True, 28), (False, 255)):
        clear = letters(None, dark=dark)
        assert (clear[..., 0] == ground).mean() > 0.02  # the box behind them
        assert clear[clear[..., 0] > 0].min() < 60
        assert clear.max() > 200


def test_the_file_says_what_it_shows():
    picture = composed(pixels(), WHITE, None)
    said = {"Recording": "towards", "Parameters": '{"gamma": 0.7}', "Frame": "γ 24"}
    read = Image.open(io.BytesIO(png(picture, said)))
    assert read.size == (300, 200)
    assert said.items() <= read.info.items()


def test_two_views_stand_side_by_side():
    left = composed(pixels(), WHITE, None)
    right = composed(np.zeros((200, 100, 4), dtype=np.uint8), WHITE, None)
    both = np.asarray(side_by_side([left, right]))
    assert both.shape == (200, 400, 3)
    assert (both[:, :150] == [200, 30, 40]).all()
    assert (both[:, 300:] == 255).all()
