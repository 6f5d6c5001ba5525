from dataclasses import replace

from app.estimates import Estimates
from app.palettes import PAPER, palette
from app.panels.status import StatusPanel, facts, notes
from estimator import Parameters
from tests.app.fake_recordings import fake_opened, fake_recording
from tests.app.fake_session import desk, shown


def said(pair):
    return {fact.name: fact.value for fact in facts(pair, palette(PAPER, dark=False))}


def test_all_numbers_of_a_pair():
    pair = Estimates().estimated(fake_opened(), 20, Parameters())
    numbers = said(replace(pair, milliseconds=61.4))
    assert numbers["Vel. error"] == "0.000 m/s"
    assert numbers["Angle error"] == "0.0°"
    del numbers["Vel. error"], numbers["Angle error"]
    assert numbers == {
        "Source": "500",
        "Target": "500",
        "Moving": "100",
        "Stationary": "400",
        "Unassigned": "0",
        "Clusters": "5",
        "Interval": "0.533 s",
        "Estimate": "61 ms",
        "Truth": "0.150 m/s",
    }
    assert notes(pair, Parameters()) == []


def test_without_a_source_it_says_why():
    pair = Estimates().estimated(fake_opened(), 2, Parameters(n=8))
    assert said(pair) == {"Source": "0", "Target": "500"}
    assert notes(pair, Parameters(n=8)) == ["No pair: frame k-n = -6 is before the start."]


def test_no_flow_means_no_errors():
    pair = Estimates().estimated(fake_opened(), 20, Parameters(delta=0.5))
    assert said(pair)["Moving"] == "0"
    assert "Angle error" not in said(pair)
    assert said(pair)["Truth"] == "0.150 m/s"


def test_an_object_at_rest_is_said():
    fake = fake_recording()
    truth = fake.pair_truth(0, 8)
    fake.pair_truth = lambda *_: type(truth)(0 * truth.velocity, 0 * truth.points)
    pair = Estimates().estimated(fake_opened(fake), 20, Parameters())
    assert notes(pair, Parameters()) == ["The moving object is at rest."]
    assert "Truth" not in said(pair)


def test_simulated_data_are_called_so(client):
    panel = StatusPanel(desk(client))
    fake = fake_recording()
    for simulated in (True, False):
        fake.simulated = simulated
        panel.show(shown(fake_opened(fake)))
        assert ("simulated" in client.text()) == simulated


def test_a_frame_that_cannot_be_shown_is_said_and_not_the_last_one_again(client):
    panel = StatusPanel(desk(client))
    panel.show(shown(fake_opened()))
    panel.show(replace(shown(fake_opened()), pair=None))
    assert "This frame cannot be shown." in client.text()
    assert "Moving" not in client.text()
