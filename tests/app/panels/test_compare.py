import re
from dataclasses import replace

import pytest

from app.analysis.comparison import A, B, Comparison
from app.analysis.estimates import Estimates
from app.panels.compare import ComparePanel
from app.panels.differences import changes, difference_table
from estimator import Parameters
from tests.app.fake_recordings import fake_opened
from tests.app.fake_session import context, snapshot


def rows(html):
    """{first cell of a row: the others}."""
    cells = [re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row) for row in html.split("<tr")]
    return {row[0]: row[1:] for row in cells if row}


@pytest.fixture(scope="module")
def estimates():
    return Estimates()


def test_every_number_of_a_and_b_and_what_lies_between(estimates):
    a = estimates.estimated(fake_opened(), 20, Parameters())
    b = estimates.estimated(fake_opened(), 20, Parameters(method="baseline"))
    said = rows(difference_table(replace(a, milliseconds=61.2), replace(b, milliseconds=40.9)))
    assert said["Moving"] == ["100", "500", "+400"]
    assert said["Stationary"] == ["400", "0", "−400"]
    assert said["Unassigned"] == ["0", "0", "+0"]
    assert said["Clusters"] == ["5", "5", "+0"]
    assert said["Coverage"] == ["1.000", "1.000", "+0.000"]
    assert said["Precision"] == ["1.000", "0.200", "−0.800"]
    # Times depend on the machine's load, so they do not compare A with B.
    assert not any("ms" in name for name in said)
    # Four patches in five rest, so that the baseline is wrong by 0.15 m/s there.
    assert said["Vel. error [m/s]"] == ["0.0000", "0.1200", "+0.1200"]


def test_what_is_not_known_is_a_dash(estimates):
    a = estimates.estimated(fake_opened(), 20, Parameters())
    said = rows(difference_table(a, None))
    assert said["Moving"] == ["100", "–", "–"]
    still = estimates.estimated(fake_opened(), 20, Parameters(delta=0.5))
    said = rows(difference_table(a, still))
    assert said["Moving"] == ["100", "0", "−100"]
    assert said["Precision"] == ["1.000", "–", "–"]
    assert set(rows(difference_table(None, None))["Clusters"]) == {"–"}


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
    assert rows(client.text())["Moving"] == ["100", "100", "+0"]
    panel.show(now)
    assert "<table" not in client.text()
