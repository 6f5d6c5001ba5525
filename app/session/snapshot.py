"""Immutable snapshots of a session's state, for its page."""

from collections.abc import Mapping
from dataclasses import dataclass

from app.analysis.comparison import Comparison
from app.analysis.library import Opened
from app.analysis.pairs import Pair
from app.analysis.survey import Survey
from app.analysis.timeline import Timeline
from app.scene.legend import Legend
from app.scene.scale_bar import ScaleBar
from app.scene.settings import ViewSettings
from app.session.choice import Listing
from app.session.clock import Playback
from app.session.inspection import Inspected
from app.session.marks import Mark
from app.session.outbox import Message
from app.session.presets import PresetUse
from app.session.tasks import TaskState
from estimator import Parameters


@dataclass(frozen=True, kw_only=True)
class Status:
    """State that is shown at once, before opening or estimating.

    Attributes:
        opening: label of the recording being opened, None without one.
        opened: the open recording, None without one.
        listing: recordings to choose from.
        parameters: of the estimate.
        parameters_revision: incremented when parameters change other than by their controls, which
            must then be updated.
        corrections: {parameter: what became of its entry, a sentence} of the last entries.
        corrected: number of corrections so far.
        preset_use: the last use of a preset, None before the first.
        tasks: running in the background.
        outbox: messages to send to the browser, exactly once.
    """

    opening: str | None
    opened: Opened | None
    listing: Listing
    parameters: Parameters
    parameters_revision: int
    corrections: Mapping[str, str]
    corrected: int
    preset_use: PresetUse | None
    tasks: tuple[TaskState, ...]
    outbox: tuple[Message, ...]


@dataclass(frozen=True, kw_only=True)
class Snapshot(Status):
    """State of a session with an open recording, after drawing a frame.

    Attributes:
        opened: the open recording.
        frame: k.
        comparison: with other parameters, None without one.
        settings: of the drawing.
        legend: of the drawing.
        scale_bar: of the page's camera, in parts of the scene's height; None without a scale.
        pair: of the frame, None if it could not be drawn.
        other: the pair with the other parameters, None unless estimated.
        picked: index of the picked cluster in the pair's flow, None without one.
        playing: whether playback is running.
        playback: of the recording.
        marks: of the recording, in the order of their frames.
        edited_mark: number of times that the mark at the frame was to be edited.
        plotted_pair: quantities (x, y) plotted against each other, None for none.
        timeline: of the recording, as far as known.
        seeking: whether the user is moving the frame slider, which must then not be set.
        survey: with these parameters, as far as filled; None before its first update.
        survey_revision: number of updates of the survey, which is filled in place.
        other_survey: with the other parameters, None without any or before its first update.
        other_survey_revision: number of its updates.
        inspected: zones and sensor that a person looks at.
        out_of_picture: whether nearly all that moves, or else all points, are.
    """

    opened: Opened
    frame: int
    comparison: Comparison | None
    settings: ViewSettings
    legend: Legend
    scale_bar: ScaleBar | None
    pair: Pair | None
    other: Pair | None
    picked: int | None
    playing: bool
    playback: Playback
    marks: tuple[Mark, ...]
    edited_mark: int
    plotted_pair: tuple[str, str] | None
    timeline: Timeline
    seeking: bool
    survey: Survey | None
    survey_revision: int
    other_survey: Survey | None
    other_survey_revision: int
    inspected: Inspected
    out_of_picture: bool = False
