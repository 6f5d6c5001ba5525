from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from app.analysis.estimates import Estimates
from app.panels.status import StatusPanel, facts, note_on
from app.panels.tables import PLOTTED, metric_title
from app.scene.palettes import PAPER, palette
from estimator import (
    Method,
    Parameters,
    SceneFlow,
    Window,
    estimate_scene_flow,
    register,
    scene_flow_of_points,
)
from tests.app.fake_recordings import PERIOD, SPEED, fake_opened, fake_recording, grid
from tests.app.fake_session import context, snapshot


def said(pair):
    return {fact.name: fact.value for fact in facts(pair, palette(PAPER, dark=False))}


def test_all_numbers_of_a_pair():
    pair = Estimates().estimated(fake_opened(), 20, Parameters())
    numbers = said(replace(pair, milliseconds=61.4))
    errors = {metric_title(name): numbers.pop(metric_title(name)) for name in PLOTTED}
    assert errors["Velocity error"] == "0.0000 m/s"
    assert errors["Angle deviation"] == "0.00°"
    assert errors["Coverage"] == errors["Precision"] == "1.000"
    assert numbers == {
        "Source": "500",
        "Target": "500",
        "Moving": "100",
        "Stationary": "400",
        "Unassigned": "0",
        "Clusters": "5",
        "Δt of the pair": "0.533 s",
        "Compute time": "61 ms",
        "True speed": "0.150 m/s",
    }
    assert note_on(pair, Parameters()) == ""


def test_without_a_source_it_says_why():
    pair = Estimates().estimated(fake_opened(), 2, Parameters(n=8))
    numbers = said(pair)
    assert (numbers.pop("Source"), numbers.pop("Target")) == ("0", "500")
    assert set(numbers.values()) == {"–"}
    assert note_on(pair, Parameters(n=8)) == "No pair: frame k-n = -6 is before the start."


def test_no_flow_means_no_errors():
    pair = Estimates().estimated(fake_opened(), 20, Parameters(delta=0.5))
    assert said(pair)["Moving"] == "0"
    assert said(pair)["Angle deviation"] == "–"
    assert said(pair)["True speed"] == "0.150 m/s"


def test_what_was_computed_before_is_called_reused():
    pair = Estimates().estimated(fake_opened(), 20, Parameters())
    assert said(replace(pair, milliseconds=61.4, reused=True))["Compute time"] == "reused"
    before = Estimates().estimated(fake_opened(), 2, Parameters())
    assert said(before)["Compute time"] == "–"


def test_an_object_at_rest_is_said():
    fake = fake_recording()
    truth = fake.pair_truth(0, 8)
    fake.pair_truth = lambda *_: type(truth)(0 * truth.velocity, 0 * truth.points)
    pair = Estimates().estimated(fake_opened(fake), 20, Parameters())
    assert note_on(pair, Parameters()) == "The moving object is at rest."
    assert said(pair)["True speed"] == "–"


def test_the_rows_are_always_the_same_so_that_the_page_does_not_jump():
    opened = fake_opened()
    pairs = [
        Estimates().estimated(opened, frame, parameters)
        for frame, parameters in [(20, Parameters()), (2, Parameters()), (20, Parameters(delta=5))]
    ]
    assert len({tuple(said(pair)) for pair in pairs}) == 1


@pytest.mark.parametrize(
    ("parameters", "why"),
    [
        (Parameters(delta=0.5), "displacements reach 0.080 m, below δ"),
        (Parameters(gamma=1.0), "fitness reaches 1.00, not above γ"),
        (Parameters(n_min=400), "every cluster is below N_min; the largest has 100 points"),
        (
            Parameters(min_cluster_size=2000),
            "no clusters; try a smaller min_cluster_size or allow a single cluster",
        ),
    ],
)
def test_why_nothing_moves_is_said_in_words(parameters, why):
    pair = Estimates().estimated(fake_opened(), 20, parameters)
    assert note_on(pair, parameters) == f"No motion found: {why}."


@pytest.mark.usefixtures("methods_of_a_test")
def test_no_advice_is_given_on_parameters_that_the_method_does_not_use():
    register(Method("still", lambda window, _: scene_flow_of_points(np.nan * window.source.points)))
    parameters = Parameters(method="still")
    pair = Estimates().estimated(fake_opened(), 20, parameters)
    assert note_on(pair, parameters) == "No motion found."


def test_without_truth_it_is_said_how_there_would_be_some():
    fake = fake_recording()
    fake.pair_truth = lambda *_: None
    pair = Estimates().estimated(fake_opened(fake), 20, Parameters())
    assert "with --truth-frame" in note_on(pair, Parameters())
    named = note_on(pair, Parameters(), "target")
    assert named == "No truth here: the truth frame has no pose over this pair."


def test_simulated_data_are_called_so(client):
    panel = StatusPanel(context(client))
    fake = fake_recording()
    for simulated in (True, False):
        fake.simulated = simulated
        panel.show(snapshot(opened=fake_opened(fake)))
        assert ("simulated" in client.text()) == simulated
        assert ("measured" in client.text()) != simulated


def test_a_frame_that_cannot_be_shown_is_said_and_not_the_last_one_again(client):
    panel = StatusPanel(context(client))
    panel.show(snapshot())
    panel.show(snapshot(pair=None))
    assert "This frame cannot be shown." in client.text()
    assert "Moving" not in client.text()


def unassigned(source: NDArray[np.float64], target: NDArray[np.float64], **parameters: Any) -> str:
    """What is said of a pair of clouds."""
    chosen = Parameters(**parameters)
    pair = Estimates().estimated(fake_opened(), 20, chosen)
    flow = estimate_scene_flow(source, target, 8 / 15, chosen)
    assert flow.moving.any()
    return note_on(replace(pair, flow=flow, truth=pair.truth), chosen)


def test_it_is_said_why_points_are_unassigned():
    shift = SPEED * 8 * PERIOD
    patches = [grid(c) for c in ([1, 1, 0.5], [-1, 1, 0.5], [1, -1, 0.5])]
    moving, small = grid([0, 0.8, 0.7]), grid([-1, -1, 0.5], side=6)
    source = np.vstack([*patches, moving, small, [[3.0, 3.0, 3.0]]])
    target = np.vstack([*patches, moving + shift, small])
    assert unassigned(source, target) == "Unassigned: 1 in no cluster, 36 in clusters below N_min."
    gone = np.vstack([*patches, moving + shift, small + np.array([0.3, 0.0, 0.0])])
    assert "36 in clusters that ICP did not match" in unassigned(source, gone, n_min=10)
    assert unassigned(source[:400], target[:400]) == ""


@pytest.mark.usefixtures("methods_of_a_test")
def test_of_a_method_without_clusters_it_is_not_said_why():
    def drift(window: Window, _: Parameters) -> SceneFlow:
        velocity = np.tile(SPEED, (len(window.source.points), 1))
        velocity[:50] = np.nan
        return scene_flow_of_points(velocity)

    register(Method("drift", drift))
    parameters = Parameters(method="drift")
    pair = Estimates().estimated(fake_opened(), 20, parameters)
    assert pair.flow is not None
    assert pair.flow.moving.sum() == 450
    assert note_on(pair, parameters) == ""
