"""Immutable snapshots of a session's state, for its page."""

from collections.abc import Mapping
from dataclasses import dataclass

from app.analysis.comparison import Comparison
from app.analysis.library import Opened
from app.analysis.pairs import Pair
from app.analysis.survey import Survey
from app.analysis.timeline import Timeline
from app.scene.legend import Legend
from app.scene.settings import ViewSettings
from app.session.clock import Playback
from app.session.outbox import Message
from app.session.presets import PresetUse
from app.session.tasks import TaskState
from app.session.tuning import Refusal
from estimator import Parameters


@dataclass(frozen=True)
class TimeSeek:
    """Seek to a time typed by the user; each seek is a new object.

    Attributes:
        seconds: from the start, as typed.
        frame: nearest to that time.
    """

    seconds: float
    frame: int


@dataclass(frozen=True, kw_only=True)
class Status:
    """State that is shown at once, before opening or estimating.

    Attributes:
        opening: label of the recording being opened, None without one.
        opened: the open recording, None without one.
        parameters: of the estimate.
        parameters_revision: incremented when parameters change other than by their controls, which
            must then be updated.
        refusals: {parameter: its refused entry}, the latest last.
        preset_use: the last use of a preset, None before the first.
        tasks: running in the background.
        outbox: messages to send to the browser, exactly once.
    """

    opening: str | None
    opened: Opened | None
    parameters: Parameters
    parameters_revision: int
    refusals: Mapping[str, Refusal]
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
        pair: of the frame, None if it could not be drawn.
        other: the pair with the other parameters, None unless estimated.
        picked: index of the picked cluster in the pair's flow, None without one.
        picked_in_scene: number of clusters picked by clicks in the scene so far.
        playing: whether playback is running.
        playback: of the recording.
        timeline: of the recording, as far as known.
        seeking: whether the user is moving the frame slider, which must then not be set.
        time_seek: the last seek to a typed time, None before the first.
        survey: with these parameters, as far as filled; None before its first update.
        survey_revision: number of updates of the survey, which is filled in place.
    """

    opened: Opened
    frame: int
    comparison: Comparison | None
    settings: ViewSettings
    legend: Legend
    pair: Pair | None
    other: Pair | None
    picked: int | None
    picked_in_scene: int
    playing: bool
    playback: Playback
    timeline: Timeline
    seeking: bool
    time_seek: TimeSeek | None
    survey: Survey | None
    survey_revision: int
