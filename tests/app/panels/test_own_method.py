"""The page with a method that it does not know: its parameters, and the story that it tells."""

import pytest

from app.analysis.estimates import Estimates
from app.panels.differences import changes
from app.panels.explain import ExplainPanel
from app.panels.parameter_controls import label_of
from app.panels.parameters import MoreParametersPanel, ParametersPanel
from app.panels.status import StatusPanel
from app.session.commands import ResetParameters
from app.session.tuning import Tuning
from estimator import PARAMETER_INFO, Parameters, changed, register
from recordings import open_recording, sample_paths
from tests.app.fake_recordings import fake_opened
from tests.app.fake_session import context, snapshot, status
from tests.own_methods import RANGE_RATE, RangeRateParameters

OWN = Parameters(method="paper")


@pytest.fixture
def own(methods_of_a_test):
    register(RANGE_RATE)
    return Parameters(method=RANGE_RATE.name, n=5)


def visible(client, label: str) -> bool:
    return client.control(label).visible


def test_controls_are_those_of_the_method_that_is_chosen(client, own):
    surroundings = context(client)
    panels = [ParametersPanel(surroundings), MoreParametersPanel(surroundings)]

    def announce(state):
        for panel in panels:
            panel.announce(state)

    assert visible(client, "γ")
    assert not visible(client, "v_0")
    announce(status(parameters=own, parameters_revision=1))
    for label in ("n", "v_0", "robust", "max range [m]", "method"):
        assert visible(client, label), label
    for label in ("γ", "δ", "N_min", "min cluster size", "min samples (0 = unset)"):
        assert not visible(client, label), label
    assert client.control("Reset").options == ("n", "v_0", "others", "all")
    announce(status(parameters_revision=2))
    assert visible(client, "γ")
    assert not visible(client, "v_0")
    sliders = [label_of(name, info) for name, info in PARAMETER_INFO.items() if info.slider]
    assert client.control("Reset").options == (*sliders, "others", "all")


def test_a_control_of_its_own_changes_its_parameter(client, own):
    posted = []
    surroundings = context(client, posted.append)
    ParametersPanel(surroundings)
    MoreParametersPanel(surroundings)
    client.change("v_0", 0.2)
    client.change("robust", False)
    assert [command.values for command in posted] == [
        {"range-rate.slowest": 0.2},
        {"range-rate.robust": False},
    ]


def test_its_parameters_are_taken_corrected_undone_and_reset(own):
    tuning = Tuning(own, own)
    ranges = {"range-rate.slowest": (0.0, 0.5)}
    tuning.enter({"range-rate.slowest": 0.2}, ranges, now=0.0)
    assert tuning.parameters.of(RangeRateParameters).slowest == 0.2
    tuning.enter({"range-rate.slowest": 99.0}, ranges, now=5.0)
    assert tuning.corrections == {
        "range-rate.slowest": "v_0 goes from 0 to 0.5 m/s: 99 became 0.5."
    }
    assert tuning.parameters.of(RangeRateParameters).slowest == 0.5
    tuning.undo(2)
    assert tuning.parameters == own
    tuning.undo(-1)
    assert tuning.parameters.of(RangeRateParameters).slowest == 0.2
    tuning.reset(ResetParameters(frozenset(["range-rate.slowest"])).names)
    assert tuning.parameters == own


def test_two_sets_of_its_parameters_are_compared_by_name(own):
    said = changes(own, changed(own, {"range-rate.slowest": 0.25}))
    assert "v_0: 0.05 → 0.25" in said


def test_its_story_is_shown_as_it_is(client, own):
    path = next(path for path in sample_paths() if "towards" in path.name)
    with open_recording(path) as recording:
        opened = fake_opened(recording)
        pair = Estimates().estimated(opened, 30, own)
        assert pair.flow is not None
        assert pair.flow.moving.any()
        shown = snapshot(opened=opened, frame=30, parameters=own, pair=pair, picked=0)
        ExplainPanel(context(client)).show(shown)
        StatusPanel(context(client)).show(shown)
    texts = " ".join(getattr(each, "content", "") for each in client._elements())
    for said in ("fastest range rate", "0.05 m/s", "seen along rays", "its ranges change"):
        assert said in texts
    for absent in ("Fitness", "Displ.", "γ"):
        assert absent not in texts
