"""What the timeline shows of a recording, a frame and a survey."""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from app.analysis.estimates import Estimates
from app.analysis.survey import Survey
from app.analysis.timeline import Timeline
from app.panels.timeline import TimelinePanel, drawable
from app.scene.colours import css
from app.scene.palettes import PALETTES
from app.session.clock import Playback
from app.session.marks import Mark
from app.session.snapshot import Snapshot
from estimator import METRIC_INFO, Parameters
from tests.app.fake_recordings import FRAMES, fake_opened, fake_recording
from tests.app.fake_session import context, snapshot
from tests.app.page_calls import frames_of, unpacked


def shown_numbers(client):
    """{frame: quantity and share of valid zones} that were sent last."""
    frames, *rows = client.shown("timeline.numbers")
    return dict(zip(frames_of(frames), zip(*map(unpacked, rows), strict=True), strict=True))


def test_only_what_has_changed_is_sent(client):
    panel, now = TimelinePanel(context(client)), snapshot()
    panel.open(now.opened)
    panel.show(now)
    client.take_sent()
    panel.show(now)
    assert client.take_sent() == []
    panel.show(replace(now, frame=21, marks=(Mark(3, "here"),)))
    assert client.shown("timeline.frame") == [21]
    assert client.shown("timeline.marks") == [[{"frame": 3, "text": "here"}]]
    assert len(client.take_sent()) == 2
    panel.open(now.opened)  # all of another recording is new
    client.take_sent()
    panel.show(now)
    assert client.shown("timeline.frame") == [now.frame]
    assert len(client.take_sent()) == 7


def test_while_a_person_moves_the_playhead_it_is_left_alone(client):
    panel, now = TimelinePanel(context(client)), snapshot()
    panel.open(now.opened)
    panel.show(replace(now, frame=21, seeking=True))
    assert client.shown("timeline.frame") is None
    panel.show(replace(now, frame=21))
    assert client.shown("timeline.frame") == [21]


def test_motion_gaps_and_empty_frames_have_the_colours_of_the_scene(client):
    panel, now = TimelinePanel(context(client)), snapshot()
    panel.open(now.opened)
    events = Timeline(FRAMES, (7,), ((0, 1),), ((5, 9),))
    for name, dark in itertools.product(PALETTES, (False, True)):
        settings = replace(now.settings, colours=name, dark=dark)
        panel.show(replace(now, settings=settings, timeline=events))
        colours = settings.palette
        assert client.shown("timeline.colours") == [
            {
                "flow": css(colours.flow),
                "empty": css(colours.unassigned),
                "gap": css(colours.category(4)),
                "mark": css(colours.category(3)),
            }
        ]
        assert len(set(client.shown("timeline.colours")[0].values())) == 4
    [sent] = client.shown("timeline.events")
    assert sent.pop("unread") == 0
    assert {name: frames_of(text) for name, text in sent.items()} == {
        "moving": [5, 6, 7, 8, 9],
        "gaps": [7],
        "empty": [0, 1],
    }


def with_a_survey(client) -> tuple[TimelinePanel, Snapshot]:
    """A panel that shows a recording, and the state with frame 20 surveyed."""
    opened, parameters = fake_opened(), Parameters()
    survey = Survey(opened.recording, parameters)
    survey.put(20, Estimates().estimated(opened, 20, parameters))
    panel = TimelinePanel(context(client))
    panel.open(opened)
    return panel, snapshot(opened=opened, survey=survey, survey_revision=1)


def test_the_quantity_is_what_the_survey_knows_of_it(client):
    panel, now = with_a_survey(client)
    for name, value, unit, top in (
        ("moving", 100.0, "", 100.0),
        ("speed", 0.15, "m/s", 0.15),
        ("coverage", 1.0, "", 1.0),
    ):
        panel.show(replace(now, settings=replace(now.settings, strip=name)))
        [about], numbers = client.shown("timeline.quantity"), shown_numbers(client)
        assert (about["chosen"], about["unit"]) == (name, unit)
        assert about["top"] >= top * 0.99
        assert [*numbers] == [12, 20]
        assert numbers[20] == pytest.approx([value, 1.0], rel=1e-3)
        assert np.isnan(numbers[12][0])
        assert numbers[12][1] == 1.0


def test_of_a_survey_that_goes_on_only_new_numbers_are_sent(client):
    panel, now = with_a_survey(client)
    panel.show(now)
    client.take_sent()
    assert now.survey is not None
    now.survey.put(21, Estimates().estimated(now.opened, 21, now.survey.parameters))
    panel.show(replace(now, survey_revision=2))
    assert [*shown_numbers(client)] == [13, 21]
    assert client.called("timeline.forget") == []
    client.take_sent()
    panel.show(replace(now, survey=None, survey_revision=3))
    assert client.called("timeline.forget") == [[]]
    assert client.called("timeline.numbers") == []


def test_quantities_are_those_of_a_survey_and_errors_need_truth():
    known, always = drawable(has_truth=True), drawable(has_truth=False)
    assert [*always] == ["points", "moving", "clusters", "interval", "speed"]
    assert {*known} - {*always} == {name for name, info in METRIC_INFO.items() if info.plotted}
    recording = fake_recording()
    survey = Survey(recording, Parameters())
    assert {len(each.values(recording, survey)) for each in known.values()} == {FRAMES}


def test_an_error_that_was_drawn_is_not_of_a_recording_without_truth(client):
    recording = fake_recording()
    recording.has_truth = False
    panel, now = TimelinePanel(context(client)), snapshot(opened=fake_opened(recording))
    panel.open(now.opened)
    panel.show(replace(now, settings=replace(now.settings, strip="coverage")))
    assert client.shown("timeline.quantity")[0]["chosen"] == "moving"
    assert client.shown("timeline.numbers") is None


def test_a_recording_of_one_frame_has_a_timeline(client):
    panel, opened = TimelinePanel(context(client)), fake_opened(fake_recording(frames=1))
    panel.open(opened)
    panel.show(snapshot(opened=opened, frame=0, playback=Playback(0, 0)))
    assert unpacked(client.shown("timeline.open")[0]).tolist() == [0.0]
    assert client.shown("timeline.frame") == [0]


def test_what_is_sent_of_an_hour_is_bounded_by_its_frames(client):
    frames = 54_000
    opened = fake_opened(fake_recording(frames=frames))
    panel, now = TimelinePanel(context(client)), snapshot()
    panel.open(opened)
    every_other = tuple((k, k) for k in range(0, frames, 2))
    events = Timeline(frames, (), every_other, every_other, unread=40)
    panel.show(replace(now, opened=opened, timeline=events))
    [sent] = client.shown("timeline.events")
    assert frames_of(sent["moving"]) == [*range(0, frames, 2)]
    assert sent["unread"] == 40
    assert len(str(sent)) < 0.6 * frames
