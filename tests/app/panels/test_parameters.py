"""Controls of the parameters, by what the session says of them."""

from dataclasses import replace

import numpy as np
import pytest

from app.browser.internals import element_id
from app.panels.parameters import HoldSlider, MoreParametersPanel, ParametersPanel
from app.session.commands import ChangeParameters, ResetParameters
from estimator import PARAMETER_INFO, Parameters
from tests.app.fake_recordings import fake_opened, fake_recording
from tests.app.fake_session import context, status

SAID = "γ goes from 0 to 1: 9 became 1."


def ends(client, label: str) -> tuple[float, float]:
    control = client.control(label)
    return control.min, control.max


def test_sliders_and_method_are_in_one_panel_and_all_others_in_another(client):
    surroundings = context(client)
    ParametersPanel(surroundings)
    assert [label for label in ("n", "γ", "δ", "N_min", "method") if client.control(label)]
    with pytest.raises(AssertionError):
        client.control("min samples (0 = unset)")
    MoreParametersPanel(surroundings)
    for label in (
        "min cluster size",
        "min samples (0 = unset)",
        "allow single cluster",
        "max range [m]",
    ):
        assert client.control(label)
    assert client.control("Reset").options == ("n", "γ", "δ", "N_min", "others", "all")
    assert client.control("History").options == ("undo", "redo")


def test_a_correction_is_said_at_the_field_of_its_control_each_time_and_forgotten(client):
    panel = ParametersPanel(context(client))
    gamma, n = (element_id(client.control(label)) for label in ("γ", "n"))
    for _ in range(2):
        panel.announce(status(corrections={"gamma": SAID}, corrected=1))
    panel.announce(status(corrections={"gamma": SAID}, corrected=2))
    assert client.called("fields.say") == [[gamma, SAID], [gamma, SAID]]
    panel.announce(status(corrections={"n": "the <last>"}, corrected=3))
    panel.announce(status(corrections={"min_samples": "elsewhere"}, corrected=4))
    panel.announce(status(corrected=4))
    assert client.called("fields.say")[2:] == [[gamma, ""], [n, "the <last>"], [n, ""]]


def test_fields_know_their_rules_and_the_new_one_where_a_recording_changes_it(client):
    panels = [made(context(client)) for made in (ParametersPanel, MoreParametersPanel)]

    def rules():
        for panel in panels:
            panel.announce(status())
        return {element: (rule, whole) for element, rule, whole in client.called("fields.rule")}

    def rule(label):
        return rules()[element_id(client.control(label))]

    assert rule("γ") == ("From 0 to 1; one beyond becomes the nearest.", False)
    assert rule("n") == ("Whole numbers from 1 to 20 frames; one beyond becomes the nearest.", True)
    assert "or 0 for unset; one beyond" in rule("min samples (0 = unset)")[0]
    sent = len(client.called("fields.rule"))
    panels[0].open(fake_opened(fake_recording(frames=8)))
    assert rule("n")[0].startswith("Whole numbers from 1 to 7 frames;")
    assert len(client.called("fields.rule")) == sent + 1


def test_what_is_entered_while_a_slider_is_pressed_is_one_change(client):
    posted = []
    ParametersPanel(context(client, posted.append))
    for held in (True, False):
        client.tell("slider", {"held": held})
    client.tell("slider", {"held": "yes"})
    assert posted == [HoldSlider(True), HoldSlider(False)]


def test_controls_are_left_alone_until_a_revision_shows_all_anew(client):
    surroundings = context(client)
    panels = [ParametersPanel(surroundings), MoreParametersPanel(surroundings)]
    client.change("δ", 0.3)
    client.change("min samples (0 = unset)", 5)

    def announce(state):
        for panel in panels:
            panel.announce(state)

    announce(status(parameters=Parameters(delta=0.1)))
    assert client.control("δ").value == 0.3  # which a person may be moving
    announce(status(parameters=Parameters(delta=0.1), parameters_revision=1))
    assert client.control("δ").value == 0.1
    assert client.control("min samples (0 = unset)").value == 0


def test_a_slider_is_wider_only_while_a_value_from_elsewhere_needs_it(client):
    panel = ParametersPanel(context(client))
    usual = ends(client, "n")
    panel.announce(status(parameters=Parameters(n=40), parameters_revision=1))
    assert (client.control("n").value, *ends(client, "n")) == (40, usual[0], 40)
    panel.announce(status(parameters=Parameters(n=5)))
    assert ends(client, "n") == usual


def test_a_flag_may_set_more_than_a_slider_offers(client):
    ParametersPanel(replace(context(client), parameters=Parameters(n_min=900)))
    assert (client.control("N_min").value, *ends(client, "N_min")) == (900, 1, 900)


@pytest.mark.parametrize(
    ("period", "frames", "largest"),
    [
        (1 / 15, 100, 20),
        (0.5, 100, 20),  # slow: no fewer than usual
        (1 / 60, 400, 81),
        (1 / 15, 8, 7),  # as far back as there are frames
        (1 / 15, 1, 2),
        (1e-4, 100_000, int(PARAMETER_INFO["n"].high)),
    ],
)
def test_n_reaches_as_far_back_as_rate_and_length_suggest(client, period, frames, largest):
    panel = ParametersPanel(context(client))
    fake = fake_recording(frames=frames)
    fake.stamps = 100 + period * np.arange(frames)
    panel.open(fake_opened(fake))
    panel.announce(status(parameters=Parameters(n=1), parameters_revision=1))
    assert ends(client, "n") == (1, largest)


def test_a_number_is_posted_with_the_range_that_its_control_has(client):
    posted = []
    ParametersPanel(context(client, posted.append))
    client.change("γ", 9.0)
    client.change("γ", 0.5)
    assert posted == [
        ChangeParameters({"gamma": 9.0}, {"gamma": (0.0, 1.0)}),
        ChangeParameters({"gamma": 0.5}, {"gamma": (0.0, 1.0)}),
    ]


def test_a_field_has_the_range_of_its_parameter_and_zero_where_it_may_be_unset(client):
    posted = []
    MoreParametersPanel(context(client, posted.append))
    info = PARAMETER_INFO["min_samples"]
    client.change("min samples (0 = unset)", 5)
    client.change("min samples (0 = unset)", 0)
    taken = {"min_samples": (0, info.high)}
    assert posted == [
        ChangeParameters({"min_samples": 5}, taken),
        ChangeParameters({"min_samples": None}, taken),
    ]
    # By which a browser corrects what was typed once the field is left.
    assert ends(client, "min samples (0 = unset)") == (0, info.high)
    assert ends(client, "min cluster size") == (2, PARAMETER_INFO["min_cluster_size"].high)


def test_resets_are_of_one_slider_of_the_others_and_of_all(client):
    posted = []
    MoreParametersPanel(context(client, posted.append))
    for option in ("γ", "others", "all"):
        client.change("Reset", option)
    until_posted = [command.names for command in posted if isinstance(command, ResetParameters)]
    sliders = {name for name, info in PARAMETER_INFO.items() if info.slider}
    one, others, everything = until_posted
    assert one == {"gamma"}
    assert others == set(PARAMETER_INFO) - sliders - {"method"} <= everything
    assert everything >= set(PARAMETER_INFO)


def test_merged_changes_know_the_last_value_and_range_of_each():
    first = ChangeParameters({"gamma": 1.0, "n": 30}, {"gamma": (0.0, 1.0), "n": (1, 15)})
    last = ChangeParameters({"n": 20}, {"n": (1, 40)})
    merged = last.merged_with(first)
    assert merged == ChangeParameters({"gamma": 1.0, "n": 20}, {"gamma": (0.0, 1.0), "n": (1, 40)})
