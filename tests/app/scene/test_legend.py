from dataclasses import replace

import numpy as np
import pytest

from app.analysis.comparison import A
from app.analysis.estimates import Estimates
from app.panels.legend import LegendPanel
from app.scene.legend import Legend, LegendEntry, legend
from app.scene.legend_html import html
from app.scene.settings import (
    BY_CLUSTER,
    BY_DIRECTION,
    BY_SPEED,
    HIDDEN,
    LAYERS,
    SHOWN,
    ViewSettings,
)
from estimator import Parameters
from tests.app.fake_recordings import fake_opened
from tests.app.fake_session import context, snapshot

FLOW = "Flow: displacement in 0.53 s × 1"


@pytest.fixture(scope="module")
def pair():
    return Estimates().estimated(fake_opened(), 20, Parameters())


def texts(pair, settings, limit=0.3):
    return [entry.text for entry in legend(pair, settings, limit).entries]


def test_it_says_what_is_drawn(pair):
    assert texts(pair, ViewSettings()) == [
        "Source: moving",
        "Source: stationary",
        "Source: unassigned",
        "Target: moving",
        "Target: static",
        FLOW,
        "True displacement",
        "True object",
    ]
    fewer = ViewSettings(layers=frozenset(LAYERS) - {"Target", "Flow"}, static_scene=HIDDEN)
    assert not [text for text in texts(pair, fewer) if text.startswith(("Target", "Flow"))]
    assert "Source: stationary" not in texts(pair, fewer)
    assert "Target" in texts(pair, ViewSettings(static_scene=SHOWN))
    twice = texts(pair, ViewSettings(arrow_scale=2.0))
    assert {FLOW.replace("× 1", "× 2"), "True displacement × 2"} <= set(twice)


def test_static_points_have_the_colour_that_is_drawn(pair):
    def colour(settings):
        return next(e.colour for e in legend(pair, settings, 0.3).entries if "stationary" in e.text)

    stationary = ViewSettings().palette.stationary
    assert colour(ViewSettings(static_scene=SHOWN)) == stationary
    assert sum(colour(ViewSettings())) > sum(stationary)
    assert sum(colour(ViewSettings(dark=True))) < sum(ViewSettings(dark=True).palette.stationary)


def test_colours_of_arrows_are_said_with_units_and_limits(pair):
    ramp = legend(pair, ViewSettings(arrow_colours=BY_SPEED), 0.3).ramp
    assert ramp is not None
    assert (ramp.low, ramp.high) == ("Flow in 0.53 s × 1: 0", "0.3 m/s")
    ramp = legend(pair, ViewSettings(arrow_colours=BY_DIRECTION), 0.3).ramp
    assert ramp is not None
    assert ramp.low == "Flow in 0.53 s × 1: −180°"
    (cluster,) = set(pair.flow.cluster[pair.flow.label == 2])
    assert f"Flow × 1: cluster {cluster}" in texts(pair, ViewSettings(arrow_colours=BY_CLUSTER))


def test_a_second_flow_is_said_where_it_is_drawn(pair):
    second = Estimates().estimated(fake_opened(), 20, Parameters(n=4))
    drawn = legend(pair, ViewSettings(), 0.3, A, second=second)
    colours = {entry.text: entry.colour for entry in drawn.entries}
    palette = ViewSettings().palette
    assert colours["Flow of A: displacement in 0.53 s × 1"] == palette.flow
    assert colours["Flow of B: displacement in 0.27 s × 1"] == palette.second
    assert FLOW not in colours
    assert "Source of A: moving" in colours
    hidden = ViewSettings(layers=frozenset(LAYERS) - {"Flow"})
    assert not [
        entry.text for entry in legend(pair, hidden, 0.3, A).entries if "Flow" in entry.text
    ]


def test_the_picked_cluster_and_clusters_beyond_the_first_few_are_said(pair):
    picked = pair.flow.clusters[1]
    drawn = legend(pair, ViewSettings(), 0.3, picked=picked).entries
    said, palette = {entry.text: entry.colour for entry in drawn}, ViewSettings().palette
    assert said[f"Picked: cluster {picked.index}"] == palette.picked
    assert said["Target: picked"] == palette.target
    assert palette.target != said["Target: others"]
    assert palette.source != said["Source: moving"]
    several = np.arange(len(pair.flow.label)) % 9
    flow = replace(pair.flow, cluster=several, label=np.full(len(several), 2))
    entries = legend(replace(pair, flow=flow), ViewSettings(arrow_colours=BY_CLUSTER), 0.3).entries
    assert "Flow × 1: 3 more clusters" in [entry.text for entry in entries]


def test_what_belongs_together_stands_in_one_row(pair):
    rows = html(legend(pair, ViewSettings(), 0.3)).count("flex-wrap")
    assert rows == len({"Source", "Target", "Flow", "Truth"})


def test_nothing_drawn_needs_no_legend():
    assert html(legend(None, ViewSettings(), 0.0)) == ""


def test_the_panel_shows_what_the_session_says(client):
    panel = LegendPanel(context(client))
    state = snapshot()
    panel.show(type(state)(**{**vars(state), "legend": Legend((LegendEntry((1, 2, 3), "a < b"),))}))
    assert "a &lt; b" in client.legend
    assert "#010203" in client.legend
