import pytest

from app.analysis.comparison import B, Comparison
from app.session.tuning import Tuning
from estimator import Parameters

GAMMA = {"gamma": (0.0, 1.0)}
SAID = "γ goes from 0 to 1: 9 became 1."


def tuning() -> Tuning:
    return Tuning(Parameters(n=5), Parameters())


def test_values_of_controls_are_taken_and_their_controls_need_not_show_them_anew():
    edited = tuning()
    edited.enter({"delta": 0.3, "gamma": 0.5}, GAMMA, now=0.0)
    assert edited.parameters == Parameters(n=5, delta=0.3, gamma=0.5)
    assert edited.revision == 0
    assert edited.corrections == {}


@pytest.mark.parametrize(
    ("name", "entered", "ends", "used", "said"),
    [
        ("gamma", 9.0, (0.0, 1.0), 1.0, SAID),
        ("gamma", -0.5, (0.0, 1.0), 0.0, "γ goes from 0 to 1: -0.5 became 0."),
        ("delta", 0.7, (0.0, 0.5), 0.5, "δ goes from 0 to 0.5 m: 0.7 became 0.5."),
        ("n", 40, (1, 20), 20, "n goes from 1 to 20 frames: 40 became 20."),
        (
            *("min_cluster_size", 1, (2, 100_000), 2),
            "min cluster size goes from 2 to 100000 points: 1 became 2.",
        ),
    ],
)
def test_a_number_beyond_its_range_becomes_the_nearest_and_is_said(name, entered, ends, used, said):
    edited = tuning()
    edited.enter({name: entered}, {name: ends}, now=0.0)
    value = getattr(edited.parameters, name)
    assert value == used
    assert type(value) is type(used)
    assert edited.corrections == {name: said}


def test_below_the_smallest_is_unset_where_that_is_possible():
    edited = Tuning(Parameters(min_samples=5), Parameters())
    ranges = {"min_samples": (0, 100_000)}
    edited.enter({"min_samples": -1}, ranges, now=0.0)
    assert edited.parameters == Parameters()
    assert edited.corrections == {
        "min_samples": "min samples goes from 0 to 100000 points: -1 became 0."
    }
    edited.enter({"min_samples": 7}, ranges, now=9.0)
    edited.enter({"min_samples": None}, ranges, now=18.0)
    assert edited.parameters == Parameters()
    assert edited.corrections == {}


def test_ends_are_in_the_range():
    edited = tuning()
    for end in (0.0, 1.0):
        edited.enter({"gamma": end}, GAMMA, now=0.0)
        assert edited.parameters.gamma == end
        assert edited.corrections == {}


def test_what_was_said_stays_until_anything_is_entered_anew():
    edited = tuning()
    edited.enter({"gamma": 9.0}, GAMMA, now=0.0)
    edited.enter({"gamma": 1.0}, GAMMA, now=1.0)  # the browser's, once the field is left
    assert edited.corrections == {"gamma": SAID}
    edited.enter({"delta": 0.2}, {}, now=2.0)
    assert edited.corrections == {}


def test_corrections_are_counted_also_equal_ones():
    edited = tuning()
    for value in (9.0, 9.0, 0.5):
        edited.enter({"gamma": value}, GAMMA, now=0.0)
    assert edited.corrected == 2


def test_what_is_entered_while_a_slider_is_pressed_is_undone_as_one():
    edited = tuning()
    for begin in (0.0, 0.5):  # two presses, the second right after the first
        edited.hold(True)
        edited.enter({"gamma": 0.4 + begin}, GAMMA, now=begin)
        edited.enter({"gamma": 0.5 + begin}, GAMMA, now=begin + 30.0)
        edited.hold(False)
    edited.undo(1)
    assert edited.parameters.gamma == 0.5
    edited.undo(1)
    assert edited.parameters == tuning().parameters


@pytest.mark.parametrize("value", ["x", None, float("nan"), (1, 2)])
def test_what_is_no_number_is_told_and_changes_nothing(value):
    edited = tuning()
    edited.enter({"gamma": value, "delta": 0.3}, GAMMA, now=0.0)
    assert edited.parameters == Parameters(n=5)
    assert set(edited.corrections) == {"gamma", "delta"}
    assert all("gamma must be" in said for said in edited.corrections.values())


def test_a_correction_is_undone_as_any_change():
    edited = tuning()
    edited.enter({"gamma": 9.0}, GAMMA, now=0.0)
    edited.undo(1)
    assert edited.parameters == Parameters(n=5)
    edited.undo(-1)
    assert edited.parameters.gamma == 1.0


def test_what_changes_nothing_is_no_change_to_undo():
    edited = tuning()
    edited.enter({"gamma": 1.0}, GAMMA, now=0.0)
    edited.enter({"gamma": 9.0}, GAMMA, now=9.0)
    edited.enter({"gamma": 1.0}, GAMMA, now=20.0)
    edited.undo(1)
    assert edited.parameters == Parameters(n=5)


def test_what_is_set_otherwise_ends_corrections_and_is_to_be_shown_anew():
    edited = tuning()

    def corrected():
        edited.enter({"gamma": 9.0}, GAMMA, now=0.0)
        return bool(edited.corrections)

    changes = (
        lambda: edited.set(Parameters(n=7)),
        lambda: edited.undo(1),
        lambda: edited.undo(-1),
        lambda: edited.reset(["n"]),
        lambda: edited.compare(Comparison(edited.parameters, B), edited.parameters),
    )
    for number, change in enumerate(changes, start=1):
        assert corrected()
        change()
        assert edited.corrections == {}
        assert edited.revision == number


def test_sets_undo_and_reset_one_after_the_other():
    edited = tuning()
    seen = []
    for change in (
        lambda: edited.set(Parameters(n=7)),
        lambda: edited.undo(1),
        lambda: edited.undo(-1),
        lambda: edited.reset(["n"]),
    ):
        change()
        seen.append(edited.parameters.n)
    assert seen == [7, 5, 7, 8]


def test_there_may_be_nothing_to_undo():
    edited = tuning()
    edited.undo(3)
    edited.undo(-3)
    assert edited.parameters == Parameters(n=5)
