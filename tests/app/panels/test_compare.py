import re
from dataclasses import replace

import pytest

from app.analysis.comparison import A, B, Comparison
from app.analysis.estimates import Estimates
from app.analysis.survey import Survey
from app.panels.compare import ComparePanel
from app.panels.differences import Totals, changes, difference_table, other_pairs, totals, verdict
from estimator import Parameters
from tests.app.analysis.test_survey import filled
from tests.app.fake_recordings import fake_opened
from tests.app.fake_session import context, snapshot


def rows(html):
    """{first cell of a row: the others}."""
    cells = [re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row) for row in html.split("<tr")]
    return {row[0]: row[1:] for row in cells if row}


@pytest.fixture(scope="module")
def estimates():
    return Estimates()


def said_of(a, b, whole_a=None, whole_b=None):
    """Rows of the table; cells without their hints."""
    counts = {A: "yes", B: "yes"}
    html = difference_table({A: a, B: b}, {A: whole_a, B: whole_b}, counts)
    return rows(re.sub(r"</?span[^>]*>", "", html))


def test_every_number_of_a_and_b_in_the_frame_and_over_the_recording(estimates):
    opened, of_b = fake_opened(), Parameters(method="baseline")
    a = estimates.estimated(opened, 20, Parameters())
    b = estimates.estimated(opened, 20, of_b)
    pairs = replace(a, milliseconds=61.2), replace(b, milliseconds=40.9)
    surveys = filled(opened, Parameters(), estimates), filled(opened, of_b, estimates)
    said = said_of(*pairs, *map(totals, surveys))
    assert said[""] == ["A", "B", "A", "B"]
    assert said["Moving"] == ["100", "500", "3200", "16000"]
    assert said["Stationary"] == ["400", "0", "12800", "0"]
    assert said["Unassigned"] == ["0", "0", "0", "0"]
    assert said["Clusters"] == ["5", "5", "160", "160"]
    # Nothing is marked where the two are equal.
    assert said["Coverage"] == ["1.000"] * 4
    assert said["Precision"] == ["<b>1.000</b>", "0.200", "<b>1.000</b>", "0.200"]
    # Times depend on the machine's load, so they do not compare A with B.
    assert not any("ms" in name for name in said)
    # Four patches in five rest, so that the baseline is wrong by 0.15 m/s there.
    assert said["Velocity error [m/s]"] == ["<b>0.0000</b>", "0.1200"] * 2
    assert said["Pairs that count"] == ["yes", "yes", "32 of 32", "32 of 32"]
    html = difference_table({A: a, B: b}, {A: None, B: None}, {A: "yes", B: "yes"})
    assert 'title="B − A: +400"' in html
    assert 'title="B − A: −0.800"' in html


def test_what_is_not_known_is_a_dash(estimates):
    a = estimates.estimated(fake_opened(), 20, Parameters())
    assert said_of(a, None)["Moving"] == ["100", "–", "–", "–"]
    still = estimates.estimated(fake_opened(), 20, Parameters(delta=0.5))
    said = said_of(a, still)
    assert said["Moving"] == ["100", "0", "–", "–"]
    assert said["Precision"] == ["1.000", "–", "–", "–"]
    assert set(said_of(None, None)["Clusters"]) == {"–"}


def test_no_side_is_the_better_one_before_the_whole_recording_is_computed(estimates):
    opened, of_b = fake_opened(), Parameters(method="baseline")
    surveys = Survey(opened.recording, Parameters()), Survey(opened.recording, of_b)
    for survey in surveys:
        survey.put(20, estimates.estimated(opened, 20, survey.parameters))
    said = said_of(None, None, *map(totals, surveys))
    assert said["Precision"] == ["–"] * 4


@pytest.mark.parametrize(
    ("of_b", "said"),
    [
        ({}, "A and B are equally good."),
        ({"angle_deg": 12.0}, "<b>A is better</b>, in angle deviation; the rest is equal."),
        (
            {"coverage": 1.0, "angle_deg": 12.0, "precision": 0.1},
            "<b>A is better in angle deviation and precision, B in coverage</b>.",
        ),
        ({"angle_deg": 10.0001}, "A and B are equally good."),  # as they are written
    ],
)
def test_a_sentence_says_which_is_better_over_the_recording(of_b, said):
    numbers = {"angle_deg": 10.0, "velocity_error": 0.1, "coverage": 0.5, "precision": 0.5}
    numbers["moving"] = 1628.0
    a, b = (Totals(values, "9 of 10", complete=True) for values in (numbers, numbers | of_b))
    assert verdict({A: a, B: b}) == f"Over the 9 of 10 pairs that count {said}"
    assert verdict({A: a, B: replace(b, complete=False)}) == ""
    assert verdict({A: a, B: None}) == ""
    assert other_pairs({A: a, B: b}) == other_pairs({A: a, B: None}) == ""
    assert "9 of 10 count for A, 8 of 9 for B" in other_pairs(
        {A: a, B: replace(b, counting="8 of 9")}
    )
    fewer = Totals(numbers | {"moving": 949.0}, "8 of 9", complete=True)
    assert verdict({A: a, B: fewer}) == (
        "Over the whole recording A and B are equally good. "
        "In all pairs A finds 1628 moving points, B 949."
    )
    unknown = replace(a, numbers=dict.fromkeys(numbers, float("nan")))
    assert verdict({A: unknown, B: unknown}).startswith("No pair counts")


def test_changed_parameters_are_named_and_no_others():
    said = changes(Parameters(), Parameters(gamma=0.5, method="baseline", max_range=3.0))
    assert "γ: 0.7 → 0.5" in said
    assert "method: paper → baseline" in said
    assert "max_range: 4 → 3" in said
    assert "δ" not in said
    assert changes(Parameters(), Parameters()) == "<div>B has the same parameters as A.</div>"


def test_order_and_switch():
    comparison = Comparison(Parameters(n=5), edited=A, both=True)
    assert comparison.in_order("edited", "other") == ("edited", "other")
    again = comparison.switched(Parameters(n=7))
    assert again == Comparison(Parameters(n=7), edited=B, both=True)
    assert again.in_order("edited", "other") == ("other", "edited")
    assert again.switched(Parameters(n=5)) == comparison


def test_the_panel_says_which_is_edited_and_what_is_not_estimated(client):
    panel, now = ComparePanel(context(client)), snapshot(parameters=Parameters(n=5))
    panel.show(now)
    assert "Copy A to B, then change it." in client.text()
    assert not client.control("Draw both").visible
    panel.show(replace(now, comparison=Comparison(Parameters(), edited=B)))
    assert "<b>B</b> is shown" in client.text()
    assert "A is not estimated here" in client.text()
    assert "n: 8 → 5" in client.text()
    assert client.control("Draw both").visible
    assert not client.control("Draw both").value
    assert client.control("Switch to A").visible
    both = Comparison(Parameters(), edited=B, both=True)
    panel.show(replace(now, comparison=both, other=snapshot().pair))
    assert client.control("Draw both").value
    assert "not estimated here" not in client.text()
    cells = rows(re.sub(r"</?span[^>]*>", "", client.text()))
    assert cells["Moving"] == ["100", "100", "–", "–"]
    assert "This frame" in client.text()
    assert "Whole recording so far: nothing yet." in client.text()
    survey = filled(now.opened, Parameters(), Estimates())
    panel.show(replace(now, comparison=both, survey=survey, other_survey=survey))
    cells = rows(re.sub(r"</?span[^>]*>", "", client.text()))
    assert cells["Moving"] == ["–", "100", "3200", "3200"]
    assert cells["Pairs that count"] == ["yes", "yes", "32 of 32", "32 of 32"]
    assert "so far" not in client.text()
    panel.show(now)
    assert "<table" not in client.text()
