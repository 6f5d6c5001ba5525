import pytest

from app.exports.figure_layout import EDGE, figure_layout, text_width
from app.exports.figure_size import TEXT, FigureSize
from app.scene.corner_line import SEPARATOR
from app.scene.legend import Legend, LegendEntry

WORDS = ("Source: moving", "Source: stationary", "Target", "Flow: displacement in 0.53 s")
LEGEND = Legend(tuple(LegendEntry((1, 2, 3), word) for word in WORDS))
LINE = ("a_recording (simulated)", "frame 24 of 38", "1.60 s", "Δt 0.533 s", "n 8 γ 0.7 δ 0.04 m")


def test_a_printed_figure_has_its_pixels_and_its_text_its_points():
    size = FigureSize.in_millimetres(88, 62, 300)
    assert (size.width, size.height) == (1039, 732)
    assert TEXT * size.pixels_per_point == pytest.approx(29.2, abs=0.1)
    finer = FigureSize.in_millimetres(88, 62, 600)
    assert finer.detail / size.detail == pytest.approx(2)
    assert size.text == "88 mm x 62 mm, 1039 x 732 pixels"


def test_a_figure_in_pixels_has_that_many_for_each_view_and_letters_that_can_be_read():
    size = FigureSize.in_pixels(1600, 900, 2)
    assert (size.width, size.height, size.text) == (3200, 900, "3200 x 900")
    assert size.detail == 900 / 720
    for small in (FigureSize.in_pixels(400, 240), FigureSize.in_pixels(200, 1000)):
        assert TEXT * small.pixels_per_point == pytest.approx(9, abs=0.5)


@pytest.mark.parametrize(("width", "height"), [(88, 62), (60, 80), (180, 80)])
def test_nothing_overlaps_or_is_cut(width, height):
    size = FigureSize.in_millimetres(width, height)
    across, down = size.points
    layout = figure_layout(size, 2, LEGEND, LINE)
    left, right = layout.views
    assert left.left == 0
    assert right.left > left.width
    assert right.left + right.width == pytest.approx(across, abs=0.5)
    assert {entry.entry for entry in layout.entries} == set(LEGEND.entries)
    places = [(e.middle, e.left, e.text_left + text_width(e.entry.text)) for e in layout.entries]
    places += [(t.middle, t.left, t.left + text_width(t.text)) for t in layout.lines]
    for middle, begin, end in places:
        assert left.height + TEXT / 2 < middle < down - TEXT / 2
        assert EDGE <= begin < end <= across
    for one in places:
        for other in places:
            if one is not other and abs(one[0] - other[0]) < TEXT:
                assert one[2] < other[1] or other[2] < one[1]


def test_the_corner_line_breaks_between_its_parts():
    layout = figure_layout(FigureSize.in_millimetres(60, 60), 1, None, LINE)
    assert len(layout.lines) > 1
    assert [part for line in layout.lines for part in line.text.split(SEPARATOR)] == list(LINE)


def test_without_texts_the_views_fill_the_figure():
    size = FigureSize.in_pixels(300, 200)
    (box,) = figure_layout(size, 1, None, ()).views
    assert (box.width, box.height) == pytest.approx(size.points)
