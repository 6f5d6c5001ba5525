from itertools import pairwise

import pytest

from app.analysis.survey_order import survey_order


@pytest.mark.parametrize("size", [1, 2, 16, 17, 100])
@pytest.mark.parametrize("near", [0, 40, 99])
def test_the_order_is_every_frame_once(size, near):
    assert sorted(survey_order(size, near)) == list(range(size))


def test_the_frame_looked_at_and_its_neighbours_come_first_and_then_the_shape():
    order = survey_order(200, 100)
    assert order[0] == 100
    assert sorted(order[:17]) == list(range(92, 109))
    assert [abs(k - 100) for k in order[:17]] == sorted(abs(k - 100) for k in order[:17])
    coarse = [k for k in range(0, 200, 16) if abs(k - 100) > 8]
    assert order[17 : 17 + len(coarse)] == coarse


def test_of_a_long_recording_some_frames_are_spread_over_all_of_it_first():
    order = survey_order(54_000, 100)
    spread = order[17 : 17 + 128]
    assert spread == sorted(spread)
    assert max(b - a for a, b in pairwise(spread)) < 54_000 / 100
    assert order[17 + 129 + 10] < 16 * 200  # then from the start
