import itertools
import re
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from app.analysis.estimates import Estimates
from app.analysis.evaluation import evaluate
from app.analysis.survey import Survey
from app.analysis.surveys import Surveys
from app.panels.plot_list import PLOTS, summary
from app.panels.plots import PlotsPanel, SavePlots
from app.panels.tables import PLOTTED
from app.panels.time_field import SeekTime
from app.scene.colours import css
from app.scene.settings import ViewSettings
from app.session.followed_survey import FollowedSurvey
from app.session.snapshot import TimeSeek
from estimator import METRIC_INFO, Parameters
from recordings import PairTruth
from tests.app.analysis.test_survey import filled
from tests.app.fake_recordings import FRAMES, PERIOD, fake_opened, fake_recording
from tests.app.fake_session import context, snapshot
from tests.app.waiting import until


class Bench:
    """A panel that shows a recording with its survey, and the commands that it posts."""

    def __init__(self, client, recording=None):
        self.client, self.posted, self.news = client, [], []
        self.survey = FollowedSurvey(Surveys(Estimates()), self.news.append)
        self.panel = PlotsPanel(context(client, self.posted.append))
        self.opened = fake_opened(recording)
        self.panel.open(self.opened)
        self.show()

    def show(self, **changes):
        self.survey.follow(self.opened, changes.get("parameters", Parameters()))
        known = {"survey": self.survey.survey, "survey_revision": self.survey.revision}
        self.panel.show(snapshot(**({"opened": self.opened} | known | changes)))

    def fill(self, **changes):
        until(lambda: self.news and self.news[-1].survey.complete)
        for news in self.news:
            self.survey.receive(news)
        self.show(**changes)

    @property
    def plots(self) -> Any:
        return self.panel._plots


def test_the_whole_recording_is_plotted_without_being_asked(client):
    bench = Bench(client)
    assert "Computing the whole recording" in client.text()
    bench.fill()
    for plot in bench.plots:
        np.testing.assert_allclose(plot.data[0], PERIOD * np.arange(FRAMES), atol=1e-9)
        assert np.isnan(plot.data[1][:8]).all()
        assert np.isfinite(plot.data[1][8:]).all()
    assert (bench.plots[0].data[1][8:] == 100).all()
    assert "Computing" not in client.text()
    assert f"Means, {FRAMES - 8} pairs with {100 * (FRAMES - 8)} flow points" in client.text()


def test_the_values_at_the_frame_are_said_and_a_line_is_drawn_there(client):
    bench = Bench(client)
    bench.fill()
    bench.show(frame=13)
    assert f"left: {100 * 13 / (FRAMES - 1):.3f}%" in client.text()
    assert ">100<" in client.text()
    bench.show(frame=3)
    assert ">100<" not in client.text()


def test_moving_on_draws_no_plot_again(client):
    bench = Bench(client)
    bench.fill()
    client.take_sent()
    bench.show(frame=21)
    size = sum(len(str(message)) for message in client.take_sent())
    assert 0 < size < 8000


def test_what_was_left_is_not_plotted(client):
    bench = Bench(client)
    bench.fill()
    late = list(bench.news)
    bench.news.clear()
    still = Parameters(delta=0.5)
    bench.show(parameters=still)
    for news in late:
        bench.survey.receive(news)
    assert bench.survey.survey is None
    bench.fill(parameters=still)
    assert (bench.plots[0].data[1][8:] == 0).all()


def test_without_truth_the_plots_that_need_none_stay_and_it_says_so(client):
    fake = fake_recording()
    fake.has_truth = False
    fake.truth = lambda _: None
    fake.pair_truth = lambda *_: None
    bench = Bench(client, fake)
    visible = [not spec.needs_truth for spec in PLOTS]
    assert [plot.visible for plot in bench.plots] == visible
    last = len(visible) - 1 - visible[::-1].index(True)
    assert labelled(bench) == [i == last for i in range(len(PLOTS))]
    bench.fill()
    assert "No truth in this recording" in client.text()
    assert ">est.<" in client.text()
    assert ">true<" not in client.text()
    assert (bench.plots[0].data[1][8:] == 100).all()


def labelled(bench):
    return ["values" not in plot.axes[0] for plot in bench.plots]


def test_the_last_plot_has_the_times_below_it(client):
    bench = Bench(client)
    assert labelled(bench) == [spec is PLOTS[-1] for spec in PLOTS]
    assert len({plot.height for plot in bench.plots[:-1]}) == 1
    assert bench.plots[-1].height > bench.plots[0].height
    assert ">true<" in client.text()


def test_the_first_and_the_last_numbers_build_every_plot_anew(client):
    bench = Bench(client)
    survey, revisions = Survey(bench.opened.recording, Parameters()), itertools.count(1)

    def built():
        client.take_sent()
        bench.show(survey=survey, survey_revision=next(revisions))
        return sum("scales" in getattr(m, "updates", {}) for m in client.take_sent())

    assert [built(), built()] == [len(bench.plots), 0]
    survey.done[:] = True
    assert built() == len(bench.plots)


def test_a_time_leads_to_the_nearest_frame():
    class Workbench:
        opened = fake_opened()
        frame = time_seek = None

        def seek(self, frame):
            self.frame = frame

    bench: Any = Workbench()
    SeekTime(1.0).apply(bench)
    assert bench.frame == 15
    assert bench.time_seek == TimeSeek(1.0, 15)
    SeekTime(1e9).apply(bench)
    assert bench.frame == FRAMES - 1


def test_the_number_field_posts_a_time(client):
    bench = Bench(client)
    client.change("Go to [s]", 1.25)
    until(lambda: SeekTime(1.25) in bench.posted)


def test_the_number_field_follows_the_frame_and_leaves_alone_what_is_typed(client):
    bench = Bench(client)
    field, at = client.control("Go to [s]"), lambda frame: round(PERIOD * frame, 3)
    bench.show(frame=24)
    assert field.value == at(24)
    client.change("Go to [s]", 1.25)
    until(lambda: bench.panel._time._typed == 1.25)
    bench.show(frame=24)  # before the session has gone there
    assert field.value == 1.25
    first = TimeSeek(1.2, 18)  # to where the first letters lead
    bench.show(frame=18, time_seek=first)
    assert field.value == 1.25
    bench.show(frame=18, time_seek=first)
    assert field.value == 1.25
    last = TimeSeek(1.25, 19)
    bench.show(frame=19, time_seek=last)
    assert field.value == 1.25
    bench.show(frame=20, time_seek=last, playing=True)  # a moment after the last letter
    assert field.value == 1.25
    bench.panel._time._typed_at -= 10
    bench.show(frame=20, time_seek=last, playing=True)
    assert field.value == at(20)
    bench.show(frame=19, time_seek=last)  # again, with no typing
    assert field.value == at(19)
    client.change("Go to [s]", 1.26)
    until(lambda: bench.panel._time._typed == 1.26)
    bench.show(frame=19, time_seek=TimeSeek(1.26, 19))
    assert field.value == 1.26
    client.change("Go to [s]", 1.25)
    until(lambda: bench.panel._time._typed == 1.25)
    bench.show(frame=19, time_seek=TimeSeek(1.25, 19))
    assert bench.panel._time._typed is None
    bench.show(frame=FRAMES - 1)
    assert field.value <= field.max


def test_points_of_what_was_left_are_pale_until_there_are_others(client):
    bench = Bench(client)
    bench.fill()
    bench.show()
    assert "opacity: 0.25" not in client.text()
    bench.news.clear()
    bench.show(parameters=Parameters(delta=0.5))
    assert "opacity: 0.25" in client.text()
    bench.fill(parameters=Parameters(delta=0.5))
    assert "opacity: 0.25" not in client.text()


def test_the_file_is_that_of_what_is_plotted(client):
    bench = Bench(client)
    bench.fill()
    client.press("Save as CSV")
    until(lambda: bench.posted)
    assert bench.posted == [SavePlots()]
    workbench: Any = SimpleNamespace(opened=bench.opened, survey=bench.survey, outbox=[])
    bench.posted[0].apply(workbench)
    (file,) = workbench.outbox
    assert file.name == "fake_plots.csv"
    assert len(file.content.decode().splitlines()) == FRAMES + 2


def test_the_summary_says_what_evaluate_says():
    opened, parameters = fake_opened(), Parameters()
    metrics = evaluate(opened.recording, parameters)
    assert metrics is not None
    said = summary(filled(opened, parameters, Estimates()), has_truth=True)
    numbers = re.findall(r"tabular-nums\">([^<]+)<", said)
    assert numbers == [METRIC_INFO[name].text(getattr(metrics, name)) for name in PLOTTED]


def test_a_recording_none_of_whose_pairs_counts_says_so():
    fake = fake_recording()
    fake.truth = lambda _: np.zeros(3)
    said = summary(filled(fake_opened(fake), Parameters()), has_truth=True)
    assert "No pair counts" in said
    assert "Of the points at rest 0.00 % got a flow." in said

    size = len(fake.cloud(0).points)
    fake.pair_truth = lambda *_: PairTruth(np.zeros((size, 3)), np.zeros((size, 3)))
    said = summary(filled(fake_opened(fake), Parameters()), has_truth=True)
    assert "Of the points at rest 20.00 % got a flow." in said
    fake.pair_truth = lambda *_: PairTruth(np.zeros((size, 3)), None)
    assert "at rest" not in summary(filled(fake_opened(fake), Parameters()), has_truth=True)


def test_while_it_is_filled_it_says_how_far_it_is():
    survey = Survey(fake_recording(), Parameters())
    assert f"8 of {FRAMES} frames" in summary(survey, has_truth=True)
    assert "width: 20%" in summary(survey, has_truth=True)


@pytest.mark.parametrize(("largest", "top"), [(0.15, 0.2), (6.6, 10), (5.0, 5), (1530, 2000)])
def test_axes_end_at_round_numbers(client, largest, top):
    bench = Bench(client)
    survey = Survey(fake_recording(), Parameters())
    survey.metrics["angle_deg"][10] = largest
    bench.show(survey=survey, survey_revision=1)
    assert bench.plots[2].scales["y"]["range"] == pytest.approx((-0.06 * top, 1.06 * top))


def test_plots_have_the_colours_of_the_scene(client):
    bench = Bench(client)
    dark = replace(ViewSettings(), dark=True)
    light, bright = css(ViewSettings().palette.flow), css(dark.palette.flow)
    assert light != bright
    assert bench.plots[0].series[1]["stroke"] == light
    bench.show(settings=dark)
    assert bench.plots[0].series[1]["stroke"] == bright
    assert bench.plots[0].series[1]["points"]["fill"] == bright
    assert f"background: {bright}" in client.text()
    assert f"background: {light}" not in client.text()
