import threading
from dataclasses import replace

import pytest

from app.analysis.estimates import Estimates
from app.panels.cluster_story import cluster_table, fills, story, telling_round
from app.panels.explain import ExplainPanel, PickAt, PickCluster
from app.panels.histograms import Histogram, upper_limit
from app.scene.colours import PICKED, css
from app.scene.settings import ViewSettings
from estimator import IcpRound, Label, Parameters
from tests.app.fake_recordings import fake_opened
from tests.app.fake_session import context, snapshot

NAN = float("nan")
COLOURS = ViewSettings().palette


@pytest.fixture(scope="module")
def clusters():
    flow = Estimates().estimated(fake_opened(), 20, Parameters()).flow
    assert flow is not None
    return flow.clusters


@pytest.fixture
def moving(clusters):
    (cluster,) = [c for c in clusters if c.label == Label.MOVING]
    return cluster


def test_labels_have_the_colours_of_the_scene():
    for colours in (COLOURS, replace(ViewSettings(), dark=True).palette):
        filled = fills(colours)
        assert css(colours.flow) in filled[Label.MOVING]
        assert css(colours.stationary) in filled[Label.STATIONARY]
        assert css(colours.unassigned) in filled[Label.UNASSIGNED]


def test_the_story_says_every_margin_and_the_reason(moving):
    text = story(moving, Parameters(gamma=0.7, delta=0.04, n_min=60), COLOURS)
    assert "100 source and 100 target points" in text
    # 0.15 m/s over eight frames of 1/15 s.
    for said in (
        *("100 / 100", "+40", "1.00", "+0.30", "0.080 m", "+0.040", "none"),
        moving.reason,
        "mean displacement 0.080 m not below δ 0.04 m",
    ):
        assert said in text
    below = story(moving, Parameters(gamma=0.7, delta=0.2, n_min=150), COLOURS)
    assert "−50" in below
    assert "−0.120" in below


def test_removed_inliers_are_those_of_the_rounds_that_removed(moving):
    first = moving.rounds[0]
    part = replace(first, inlier_source=first.inlier_source[:30], fitness=0.3)
    again = replace(moving, rounds=(part, first))
    assert story(again, Parameters(), COLOURS).count("30 / 100") == 1
    assert story(again, Parameters(), COLOURS).count("none") == 1
    given_up = replace(again, label=Label.UNASSIGNED)
    assert "none" not in story(given_up, Parameters(), COLOURS)


def test_a_round_that_pairs_nothing_has_no_fitness_and_no_displacement(moving):
    first = moving.rounds[0]
    nothing = first.inlier_source[:0]
    empty = replace(
        first, fitness=0.0, mean_displacement=0.0, inlier_source=nothing, inlier_target=nothing
    )
    given_up = replace(moving, rounds=(first, empty), label=Label.UNASSIGNED)
    told = story(given_up, Parameters(), COLOURS)
    assert "no pairs" in told
    assert "0.000 m" not in told
    assert "0 / 0" not in told
    assert told.count("+40") == 2  # its points are as many as before
    assert "no pairs" not in story(moving, Parameters(), COLOURS)
    never = replace(given_up, rounds=(empty,))
    row = cluster_table([never], None, COLOURS, no_click)
    assert "no pairs" in row
    assert "0.00" not in row


def test_a_cluster_that_was_skipped_has_no_round_and_still_a_reason(moving):
    text = story(
        replace(moving, rounds=(), reason="Unassigned: few <points>."), Parameters(), COLOURS
    )
    assert "Unassigned: few &lt;points&gt;." in text
    assert "<table" not in text


def test_the_round_that_tells_is_the_one_that_decided_or_the_one_of_the_highest_fitness(moving):
    rounds = tuple(replace(moving.rounds[0], fitness=fitness) for fitness in (0.3, 0.6, 0.1))
    decided = replace(moving, rounds=rounds)
    assert telling_round(decided) is rounds[2]
    given_up = replace(decided, label=Label.UNASSIGNED)
    assert telling_round(given_up) is rounds[1]
    for cluster in (replace(moving, rounds=()), replace(given_up, rounds=())):
        assert telling_round(cluster) is None
    told = story(given_up, Parameters(), COLOURS)
    assert "The fitness was 0.60 at best, in round 2; γ is 0.7." in told
    assert "at best" not in story(decided, Parameters(), COLOURS)
    table = cluster_table([given_up], None, COLOURS, no_click)
    assert "0.60" in table
    assert "0.080 m" in table


def no_click(cluster):
    return ""


def test_the_table_marks_the_picked_cluster_alone(clusters, moving):
    assert cluster_table(clusters, None, COLOURS, no_click).count(css(PICKED)) == 0
    table = cluster_table(
        [*clusters, replace(moving, index=9, rounds=())], moving.index, COLOURS, no_click
    )
    assert table.count(css(PICKED)) == 1
    assert table.count("<tr") == 7
    assert "–" in table
    assert "No clusters" in cluster_table([], None, COLOURS, no_click)


def test_bars_count_by_label_and_the_last_takes_what_lies_beyond():
    moving, still = Label.MOVING, Label.STATIONARY
    values = [
        (0.0, still),
        (0.19, moving),
        (0.95, still),
        (1.0, still),
        (7.0, moving),
        (NAN, still),
    ]
    counts = Histogram("h", values, 1.0, 5, ("γ", 0.5), COLOURS).counts()
    assert [bar.total() for bar in counts] == [2, 0, 0, 0, 3]
    assert counts[4] == {still: 2, moving: 1}


def test_the_threshold_is_a_line_where_it_belongs():
    def line(threshold):
        svg = Histogram("h", [], 1.0, 5, ("γ", threshold), COLOURS).svg()
        assert f"γ {threshold:g}" in svg
        return float(svg.split("stroke-dasharray")[0].rsplit('d="M', 1)[1].split()[0])

    start, middle, end = line(0.0), line(0.5), line(1.0)
    assert start < middle < end
    assert middle == pytest.approx((start + end) / 2)


@pytest.mark.parametrize(
    ("values", "limit"), [([0.08], 0.1), ([138, NAN], 200), ([500], 500), ([], 1), ([0.0, NAN], 1)]
)
def test_axes_end_at_a_round_number(values, limit):
    assert upper_limit(values) == pytest.approx(limit)


def test_the_panel_lists_the_clusters_and_tells_the_picked_ones_story(client, moving):
    panel, now = ExplainPanel(context(client)), snapshot()
    panel.show(now)
    assert len(client.control("Cluster").options) == 6
    assert client.control("Cluster").value == "none"
    assert moving.reason not in client.text()
    panel.show(replace(now, picked=moving.index))
    panel.show(replace(now, picked=moving.index))
    assert client.called("story.show") == [[]]  # once: it may be below the edge of the panel
    assert client.control("Cluster").value == f"{moving.index} moving"
    assert moving.reason in client.text()
    text = client.text()  # in the order of the page
    assert text.index("Fitness</th>") < text.index(moving.reason) < text.index("<svg viewBox")
    panel.show(replace(now, pair=None))
    assert client.control("Cluster").options == ("none",)
    assert "There is no estimate of this frame to explain." in client.text()
    assert "<svg" not in client.text()


def test_what_moves_has_the_colour_of_the_flow_on_every_page(client, moving):
    panel, now = ExplainPanel(context(client)), snapshot()
    dark = replace(now, settings=replace(now.settings, dark=True))
    light, bright = (f'fill="{css(s.settings.palette.flow)}"' for s in (now, dark))
    panel.show(replace(now, picked=moving.index))
    assert light in client.text()
    panel.show(replace(dark, picked=moving.index))
    assert light not in client.text()
    assert client.text().count(bright) >= 5  # table, story, two bars and what they mean


def test_what_a_person_picks_is_posted(client):
    posted, clicked = [], threading.Event()

    def post(command):
        posted.append(command)
        if isinstance(command, PickAt):
            clicked.set()

    panel = ExplainPanel(context(client, post))
    panel.show(snapshot())
    assert posted == []
    client.change("Cluster", client.control("Cluster").options[2])
    client.change("Cluster", "none")
    client.click((0.0, 1.0, 2.0), (0.0, 0.0, 1.0))
    assert clicked.wait(10)
    assert posted == [PickCluster(1), PickCluster(None), PickAt((0.0, 1.0, 2.0), (0.0, 0.0, 1.0))]


def test_rounds_are_told_in_their_order(moving):
    rounds: tuple[IcpRound, ...] = tuple(
        replace(moving.rounds[0], fitness=fitness) for fitness in (0.11, 0.22, 0.93)
    )
    text = story(replace(moving, rounds=rounds), Parameters(), COLOURS)
    assert text.index("0.11") < text.index("0.22") < text.index("0.93")
