"""Snapshot of a session: all that its page shows, immutable, in two steps."""

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
    """Frame that a time has led to; another one each time that it is time_seek.

    Attributes:
        seconds: from the start, as they were typed.
        frame: nearest to them.
    """

    seconds: float
    frame: int


@dataclass(frozen=True, kw_only=True)
class Status:
    """State that the page shows at once, before anything is opened or estimated.

    Attributes:
        opening: label of the recording that is being opened, None where none is.
        opened: the recording, None while none is open.
        parameters: of the estimate.
        parameters_revision: grows whenever parameters were set by something else than their own
            controls, which are then to show all of them anew.
        refusals: {parameter: entry that is not taken}, the last one at the end.
        preset_use: the last use of a preset, None where none was used.
        tasks: that run in the background.
        outbox: messages to hand to the browser, exactly once.
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
    """State of a session that shows a recording, once its frame was drawn.

    Attributes:
        opened: the recording.
        frame: k.
        comparison: with other parameters, None where there is none.
        settings: of the drawing.
        legend: meaning of its colours.
        pair: of the frame, None where it could not be drawn.
        other: the pair with those other parameters, None unless its estimate is known.
        picked: index of the picked cluster in the pair's flow, None where none is.
        picked_in_scene: number of clusters that were picked by a click in the scene so far.
        playing: whether time goes on.
        playback: of the recording.
        timeline: of the recording, as far as it is known.
        seeking: whether a person is moving the frame slider, which is then left to them.
        time_seek: the last time that a person typed, None where none was.
        survey: with these parameters, as far as it is filled; None before its first numbers.
        survey_revision: grows whenever the survey has come further: it is filled in place.
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
