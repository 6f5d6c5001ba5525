"""What a panel of the page is: it posts wishes, and shows what the session shows."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import viser

from app.analysis.comparison import Comparison
from app.analysis.estimates import Pair
from app.analysis.library import Entry, Opened
from app.analysis.surveys import Surveys
from app.analysis.timeline import Timeline
from app.scene.legend import Legend
from app.scene.settings import ViewSettings
from app.session.clock import Playback
from app.session.queue import Wish
from estimator import Parameters


@dataclass(frozen=True)
class Desk:
    """What a panel is made with.

    Attributes:
        client: the browser client.
        entries: recordings to choose from, at least one.
        parameters: to begin with.
        settings: to begin with.
        post: takes wishes, from any thread.
        surveys: of whole recordings, computed in the background.
    """

    client: viser.ClientHandle
    entries: Sequence[Entry]
    parameters: Parameters
    settings: ViewSettings
    post: Callable[[Wish], None]
    surveys: Surveys


@dataclass(frozen=True)
class Shown:
    """What a session shows at one moment.

    Attributes:
        opened: the recording.
        frame: k.
        parameters: of the estimate.
        settings: of the drawing.
        legend: what its colours mean.
        pair: of the frame, None where it could not be drawn.
        comparison: with other parameters, None where there is none.
        other: the pair with those other parameters, None unless its estimate is known.
        picked: index of the picked cluster in the pair's flow, None where none is.
        playing: whether time goes on.
        playback: how it is played.
        timeline: of the recording, as far as it is known.
        seeking: whether a person is moving the frame slider on, which is then left to them.
    """

    opened: Opened
    frame: int
    parameters: Parameters
    settings: ViewSettings
    legend: Legend
    pair: Pair | None
    comparison: Comparison | None
    other: Pair | None
    picked: int | None
    playing: bool
    playback: Playback
    timeline: Timeline
    seeking: bool


class Panel:
    """A part of the page. Its methods are called by the session's thread alone.

    A panel adds its controls when it is made, and posts wishes from their callbacks.
    """

    def __init__(self, desk: Desk) -> None:
        del desk

    def open(self, opened: Opened) -> None:
        """Prepare for a recording that was opened."""

    def show(self, shown: Shown) -> None:
        """Show what the session shows; called whenever that may have changed."""

    def close(self) -> None:
        """Let go of the recording, which is about to be closed."""

    def leave(self) -> None:
        """End what is done for the client, which has gone."""
