from app.analysis.comparison import B, Comparison
from app.session.tuning import Refusal, Tuning
from estimator import Parameters

NO_GAMMA = "gamma must be between 0 and 1, got 9.0."


def tuning() -> Tuning:
    return Tuning(Parameters(n=5), Parameters())


def test_values_of_controls_are_taken_and_their_controls_need_not_show_them_anew():
    edited = tuning()
    edited.enter({"delta": 0.3, "gamma": 0.5}, (), now=0.0)
    assert edited.parameters == Parameters(n=5, delta=0.3, gamma=0.5)
    assert edited.revision == 0
    assert edited.refusals == {}


def test_what_is_out_of_range_is_refused_whole_until_something_is_taken():
    edited = tuning()
    edited.enter({"gamma": 9.0, "delta": 0.3}, (), now=0.0)
    assert edited.parameters == Parameters(n=5)
    assert edited.refusals == {"gamma": Refusal(NO_GAMMA), "delta": Refusal(NO_GAMMA)}
    edited.enter({"delta": 0.2}, (), now=1.0)
    assert edited.parameters == Parameters(n=5, delta=0.2)
    assert edited.refusals == {}


def test_the_last_refusal_is_at_the_end():
    edited = tuning()
    for name, value in (("gamma", 9.0), ("n", 0), ("gamma", 8.0)):
        edited.enter({name: value}, (), now=0.0)
    assert [*edited.refusals] == ["n", "gamma"]
    assert "got 8.0" in edited.refusals["gamma"].reason


def test_an_end_of_a_slider_after_a_refusal_is_no_entry_and_the_reason_stays():
    edited = tuning()
    edited.enter({"gamma": 9.0}, (), now=0.0)
    edited.enter({"gamma": 1.0}, {"gamma"}, now=1.0)
    assert edited.parameters.gamma == 0.7
    assert edited.refusals == {"gamma": Refusal(NO_GAMMA, clamped=True)}
    # The person goes there on purpose now.
    edited.enter({"gamma": 1.0}, {"gamma"}, now=2.0)
    assert edited.parameters.gamma == 1.0
    assert edited.refusals == {}


def test_an_end_of_a_slider_is_an_entry_where_nothing_was_refused():
    edited = tuning()
    edited.enter({"gamma": 1.0}, {"gamma"}, now=0.0)
    assert edited.parameters.gamma == 1.0


def test_what_is_set_otherwise_ends_refusals_and_is_to_be_shown_anew():
    edited = tuning()

    def refused():
        edited.enter({"gamma": 9.0}, (), now=0.0)
        return bool(edited.refusals)

    changes = (
        lambda: edited.set(Parameters(n=7)),
        lambda: edited.undo(1),
        lambda: edited.undo(-1),
        lambda: edited.reset(["n"]),
        lambda: edited.compare(Comparison(edited.parameters, B), edited.parameters),
    )
    seen = []
    for number, change in enumerate(changes, start=1):
        assert refused()
        change()
        assert edited.refusals == {}
        assert edited.revision == number
        seen.append(edited.parameters.n)
    assert seen == [7, 5, 7, 8, 8]


def test_there_may_be_nothing_to_undo():
    edited = tuning()
    edited.undo(3)
    edited.undo(-3)
    assert edited.parameters == Parameters(n=5)
