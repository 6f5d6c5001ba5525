"""Two sets of parameters, and what is estimated of a frame with them."""

import pytest

import app.analysis.pair_estimator
from app.analysis.comparison import A, B, Comparison, estimate_frame
from app.analysis.estimates import Estimates
from estimator import Parameters
from tests.app.fake_recordings import fake_opened

EDITED, OTHER = Parameters(), Parameters(delta=0.5)


def test_a_switch_and_another_one_lead_back():
    comparison = Comparison(OTHER)
    switched = comparison.switched(EDITED)
    assert (switched.edited, switched.other) == (B, EDITED)
    assert switched.switched(OTHER) == comparison


@pytest.mark.parametrize("edited", [A, B])
def test_sides_keep_their_order_whichever_is_edited(edited: str):
    comparison = Comparison(OTHER, edited, both=True)
    of_a, of_b = (EDITED, OTHER) if edited == A else (OTHER, EDITED)
    assert comparison.in_order(EDITED, OTHER) == (of_a, of_b)
    assert comparison.drawn(EDITED) == {A: of_a, B: of_b}


def test_where_one_is_drawn_there_are_no_two_sides():
    assert Comparison(OTHER).drawn(EDITED) == {}


def test_the_other_is_estimated_where_it_is_drawn_and_looked_up_where_not():
    estimates, opened = Estimates(), fake_opened()
    one = Comparison(OTHER)
    assert estimate_frame(estimates, opened, 20, EDITED, None).other is None
    assert estimate_frame(estimates, opened, 20, EDITED, one).other is None
    both = estimate_frame(estimates, opened, 20, EDITED, Comparison(OTHER, both=True))
    assert both.pair.anything_moves
    assert both.second is not None
    assert both.other is both.second
    assert not both.second.anything_moves
    again = estimate_frame(estimates, opened, 20, EDITED, one)
    assert again.other is both.second
    assert again.second is None


def test_an_estimate_that_fails_leaves_the_clouds_and_its_error(monkeypatch: pytest.MonkeyPatch):
    def fail(*_: object) -> None:
        raise ZeroDivisionError("oh")

    monkeypatch.setattr(app.analysis.pair_estimator, "estimate", fail)
    found = estimate_frame(Estimates(), fake_opened(), 20, EDITED, Comparison(OTHER, both=True))
    assert isinstance(found.problem, ZeroDivisionError)
    assert found.pair.source is not None
    assert found.pair.flow is None
