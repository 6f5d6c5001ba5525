"""The panel of plots: what it sends to the page, and what it says."""

import json
from base64 import b64decode
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np

from app.analysis.comparison import A, B, Comparison
from app.analysis.estimates import Estimates
from app.analysis.survey import Survey
from app.analysis.surveys import Surveys
from app.panels.plot_list import PLOTS, plots
from app.panels.plot_pair import PlotPair
from app.panels.plot_words import HOLLOW
from app.panels.plots import Enlarge, PlotsPanel
from app.scene.colours import css
from app.scene.settings import ViewSettings
from app.session.commands import Refuse, seek
from app.session.followed_survey import FollowedSurvey
from app.session.outbox import EnlargePlots
from estimator import Parameters
from tests.app.analysis.test_survey import filled
from tests.app.fake_recordings import FRAMES, PERIOD, fake_opened, fake_recording
from tests.app.fake_session import context, snapshot
from tests.app.waiting import until


def calls(client, function):
    """Arguments of the calls of a function of the page's plots, of all messages so far."""
    start = f"window.tofscope.plots.{function}("
    sources = [getattr(message, "source", "") for message in client.sent]
    found = [source for source in sources if source.startswith(start)]
    return [json.loads(f"[{source[len(start) : -2]}]") for source in found]


def decoded(text, kind) -> Any:
    return np.frombuffer(b64decode(text), kind)


class Page:
    """What the page has been told: the numbers of each side, by frame."""

    def __init__(self, client):
        self.client = client

    def numbers(self, side, name):
        (times, _) = calls(self.client, "open")[-1]
        values = np.full(len(decoded(times, "<f8")), np.nan)
        for of, frames, _, arrays in calls(self.client, "add"):
            if of == side and name in arrays:
                values[decoded(frames, "<u4")] = decoded(arrays[name], "<f4")
        return values

    def counts(self, side):
        (times, _) = calls(self.client, "open")[-1]
        counts = np.full(len(decoded(times, "<f8")), -1)
        for of, frames, flags, _ in calls(self.client, "add"):
            if of == side:
                counts[decoded(frames, "<u4")] = decoded(flags, "u1")
        return counts


class Bench:
    """A panel that shows a recording with its survey, and the commands that it posts."""

    def __init__(self, client, recording=None):
        self.client, self.posted, self.news = client, [], []
        self.page = Page(client)
        self.survey = FollowedSurvey(Surveys(Estimates()), self.news.append)
        self.panel = PlotsPanel(context(client, self.posted.append))
        self.opened = fake_opened(recording)
        self.panel.open(self.opened)
        self.show()

    def show(self, **changes):
        self.survey.follow(self.opened, changes.get("parameters", Parameters()), 20)
        known = {"survey": self.survey.survey, "survey_revision": self.survey.revision}
        self.panel.show(snapshot(**({"opened": self.opened} | known | changes)))

    def fill(self, **changes):
        survey = self.survey.survey
        assert survey is not None
        until(lambda: survey.complete and (not self.news or self.news[-1].survey.complete))
        for news in self.news:
            self.survey.receive(news)
        self.show(**changes)


def test_the_whole_recording_is_plotted_without_being_asked(client):
    bench = Bench(client)
    assert "Computing the whole recording" in client.text()
    bench.fill()
    ((times, quantities),) = calls(client, "open")
    np.testing.assert_allclose(decoded(times, "<f8"), PERIOD * np.arange(FRAMES), atol=1e-9)
    assert [quantity["name"] for quantity in quantities] == list(PLOTS)
    for name in (*PLOTS, "true_speed"):
        values = bench.page.numbers(A, name)
        assert np.isnan(values[:8]).all()
        assert np.isfinite(values[8:]).all()
    assert (bench.page.numbers(A, "moving")[8:] == 100).all()
    assert "Computing" not in client.text()
    assert HOLLOW in client.text()
    pairs = FRAMES - 8
    assert calls(client, "say")[-1][0]["coverage"] == f"Mean 1.000, {pairs} of {pairs} pairs count"


def test_every_frame_is_sent_once(client):
    bench = Bench(client)
    client.take_sent()
    survey, estimates = Survey(bench.opened.recording, Parameters()), Estimates()
    for revision, k in enumerate((20, 12, 30), start=1):
        survey.put(k, estimates.estimated(bench.opened, k, Parameters()))
        bench.show(survey=survey, survey_revision=revision)
        bench.show(survey=survey, survey_revision=revision)
    sent = [list(decoded(frames, "<u4")) for _, frames, _, _ in calls(client, "add")]
    assert sent == [[*range(8), 20], [12], [30]]


def test_the_frame_is_told_and_nothing_else(client):
    bench = Bench(client)
    bench.fill()
    client.take_sent()
    bench.show(frame=21)
    assert calls(client, "at") == [[21]]
    size = sum(len(str(message)) for message in client.take_sent())
    assert 0 < size < 500


def test_pairs_that_do_not_count_are_hollow(client):
    fake = fake_recording()
    fake.truth = lambda k: np.zeros(3) if k < 20 else np.array([0.0, 0.15, 0.0])
    bench = Bench(client, fake)
    bench.fill()
    np.testing.assert_array_equal(bench.page.counts(A), np.arange(FRAMES) >= 28)
    assert np.isfinite(bench.page.numbers(A, "angle_deg")[8:]).all()
    note = calls(client, "say")[-1][0]["angle_deg"]
    assert note.endswith(f"{FRAMES - 28} of {FRAMES - 8} pairs count")


def test_b_is_plotted_over_a_whichever_is_edited(client):
    bench = Bench(client)
    opened, estimates = bench.opened, Estimates()
    of_a = filled(opened, Parameters(), estimates)
    of_b = filled(opened, Parameters(method="baseline", n=5), estimates)
    both = Comparison(Parameters(), edited=B)
    bench.show(
        comparison=both, survey=of_b, other_survey=of_a, survey_revision=1, other_survey_revision=1
    )
    colours = ViewSettings().palette
    (sides, looks) = calls(client, "look")[-1]
    assert sides == [A, B]
    assert looks == {A: css(colours.flow), B: css(colours.second), "truth": css(colours.truth)}
    assert (bench.page.numbers(A, "moving")[8:] == 100).all()
    assert (bench.page.numbers(B, "moving")[5:] == 500).all()
    said = calls(client, "say")[-1][0]["precision"]
    assert said == "Mean A 1.000, 32 of 32 pairs count; B 0.200, 35 of 35 pairs count"
    client.take_sent()
    swapped = both.switched(Parameters())
    bench.show(
        comparison=swapped,
        survey=of_a,
        other_survey=of_b,
        survey_revision=1,
        other_survey_revision=1,
    )
    assert not calls(client, "add")
    assert not calls(client, "outdate")
    bench.show(survey=of_a, survey_revision=1)
    assert calls(client, "look")[-1][0] == [A]


def test_what_was_left_is_not_plotted(client):
    bench = Bench(client)
    bench.fill()
    late = list(bench.news)
    bench.news.clear()
    still = Parameters(delta=0.5)
    bench.show(parameters=still)
    assert calls(client, "outdate") == [[A]]  # drawn pale until there are others
    for news in late:
        bench.survey.receive(news)
    survey = bench.survey.survey
    assert survey is not None
    assert survey.parameters == still
    bench.fill(parameters=still)
    assert (bench.page.numbers(A, "moving")[8:] == 0).all()
    assert len(calls(client, "outdate")) == 1


def test_without_truth_the_plots_that_need_none_stay_and_it_says_so(client):
    fake = fake_recording()
    fake.has_truth = False
    fake.truth = lambda _: None
    fake.pair_truth = lambda *_: None
    bench = Bench(client, fake)
    ((_, quantities),) = calls(client, "open")
    assert [quantity["name"] for quantity in quantities] == ["moving", "speed"]
    assert not any(quantity["reference"] for quantity in quantities)
    bench.fill()
    assert "No truth in this recording" in client.text()
    assert "Hollow" not in client.text()
    assert (bench.page.counts(A) == 1).all()
    assert (bench.page.numbers(A, "moving")[8:] == 100).all()
    assert all(notes == {} for notes, _ in calls(client, "say"))


def test_values_are_written_and_drawn_as_their_quantity_says():
    shown = {quantity.name: quantity for quantity in plots(has_truth=True)}
    assert (shown["angle_deg"].title, shown["angle_deg"].unit) == ("Angle deviation", "°")
    assert (shown["velocity_error"].unit, shown["velocity_error"].digits) == ("m/s", 4)
    assert (shown["coverage"].top, shown["angle_deg"].top) == (1.0, None)
    assert shown["moving"].digits == 0
    assert shown["speed"].reference == "true_speed"


def test_any_two_quantities_are_plotted_against_each_other(client):
    bench = Bench(client)
    bench.fill()
    client.change("against", "Source points")
    client.change("Plot", "False flow")
    until(lambda: PlotPair(("points", "false_flow")) in bench.posted)
    workbench: Any = SimpleNamespace(plotted_pair=None)
    bench.posted[-1].apply(workbench)
    bench.show(plotted_pair=workbench.plotted_pair)
    (pair,) = calls(client, "pair")[-1]
    assert (pair["x"]["name"], pair["y"]["name"]) == ("points", "false_flow")
    assert (bench.page.numbers(A, "points")[8:] == 500).all()
    assert (bench.page.numbers(A, "false_flow")[8:] == 0).all()
    client.change("Plot", "nothing")
    until(lambda: PlotPair(None) in bench.posted)
    bench.show()
    assert calls(client, "pair")[-1] == [None]
    client.change("Plot", "<b>")
    until(lambda: isinstance(bench.posted[-1], Refuse))


def test_a_click_seeks(client):
    bench = Bench(client)
    client.tell("plots.seek", {"frame": 17})
    client.tell("plots.seek", {"frame": "17"})
    until(lambda: seek(17) in bench.posted)
    assert len([command for command in bench.posted if command == seek(17)]) == 1


def test_the_plots_can_be_enlarged_from_the_palette(client):
    bench = Bench(client)
    client.trigger("Enlarge plots")
    until(lambda: Enlarge() in bench.posted)
    workbench: Any = SimpleNamespace(outbox=[])
    Enlarge().apply(workbench)
    assert workbench.outbox == [EnlargePlots()]


def test_plots_have_the_colours_of_the_scene(client):
    bench = Bench(client)
    dark = replace(ViewSettings(), dark=True)
    light, bright = css(ViewSettings().palette.flow), css(dark.palette.flow)
    assert light != bright
    assert calls(client, "look")[-1][1][A] == light
    bench.show(settings=dark)
    assert calls(client, "look")[-1][1][A] == bright
