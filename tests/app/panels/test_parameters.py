"""Controls of the parameters, by what the session says of them."""

from app.panels.parameters import ParametersPanel
from app.session.commands import ChangeParameters
from app.session.tuning import Refusal
from estimator import Parameters
from tests.app.fake_session import context, status

REASON = "gamma must be between 0 and 1, got 9.0."


def refusal_seen(client) -> bool:
    shown = [c for c in client._elements() if REASON in getattr(c, "content", "")]
    return any(control.visible for control in shown)


def test_a_refused_value_stays_until_another_is_taken(client):
    panel = ParametersPanel(context(client))
    client.change("γ", 9.0)
    client.change("δ", 0.3)
    panel.announce(status(refusals={"gamma": Refusal(REASON)}))
    assert client.control("γ").value == 9.0
    assert refusal_seen(client)
    panel.announce(status())
    assert client.control("γ").value == 0.7
    assert client.control("δ").value == 0.3  # which a person may be moving
    assert not refusal_seen(client)


def test_what_the_browser_clamped_shows_what_is_in_use_and_the_reason_is_readable(client):
    panel = ParametersPanel(context(client))
    client.change("γ", 9.0)
    panel.announce(status(refusals={"gamma": Refusal(REASON)}))
    client.change("γ", 1.0)
    clamped = status(refusals={"gamma": Refusal(REASON, clamped=True)})
    panel.announce(clamped)
    assert client.control("γ").value == 0.7
    assert refusal_seen(client)
    panel._readable_until = 0.0
    panel.announce(clamped)
    assert not refusal_seen(client)


def test_a_new_revision_shows_all_parameters_anew(client):
    panel = ParametersPanel(context(client))
    client.change("δ", 0.3)
    client.change("min samples", 5)
    panel.announce(status(parameters=Parameters(n=40, delta=0.1)))
    assert client.control("δ").value == 0.3
    panel.announce(status(parameters=Parameters(n=40, delta=0.1), parameters_revision=1))
    assert client.control("δ").value == 0.1
    assert client.control("min samples").value == 0
    assert (client.control("n").value, client.control("n").max) == (40, 40)


def test_the_end_of_a_slider_is_told_with_its_value(client):
    posted = []
    ParametersPanel(context(client, posted.append))
    client.change("γ", 1.0)
    client.change("γ", 0.5)
    client.change("min samples", 5)
    client.change("min samples", 0)
    assert posted == [
        ChangeParameters({"gamma": 1.0}, frozenset({"gamma"})),
        ChangeParameters({"gamma": 0.5}),
        ChangeParameters({"min_samples": 5}),
        ChangeParameters({"min_samples": None}),
    ]


def test_merged_changes_know_the_ends_of_the_last_values():
    first = ChangeParameters({"gamma": 1.0, "n": 30}, frozenset({"gamma", "n"}))
    last = ChangeParameters({"gamma": 0.5})
    merged = last.merged_with(first)
    assert merged == ChangeParameters({"gamma": 0.5, "n": 30}, frozenset({"n"}))
