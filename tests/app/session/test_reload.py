from app.session.links import SavedSession
from app.session.reload import Reloads
from estimator import Parameters

LEFT = SavedSession("a", 3, Parameters(n=2))


def test_what_was_left_is_handed_out_once():
    reloads = Reloads()
    reloads.keep("token", LEFT)
    assert reloads.take("token") == LEFT
    assert reloads.take("token") is None


def test_unknown_tokens_get_nothing():
    reloads = Reloads()
    reloads.keep("token", LEFT)
    assert reloads.take("another") is None
    assert reloads.take(None) is None


def test_the_oldest_are_forgotten():
    reloads = Reloads(size=2)
    for token in "abc":
        reloads.keep(token, LEFT)
    assert [reloads.take(token) for token in "abc"] == [None, LEFT, LEFT]
