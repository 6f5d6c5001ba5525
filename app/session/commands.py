"""Commands that several panels post, or the session itself; a panel defines its own beside it."""

from collections.abc import Mapping
from dataclasses import dataclass
from time import monotonic
from typing import Any, Self

from app.session.command import Background, LatestWins, Repeated
from app.session.followed_survey import SurveyUpdate
from app.session.links import SavedSession
from app.session.tasks import TaskEvent
from app.session.workbench import Workbench


@dataclass(frozen=True)
class OpenRecording(LatestWins):
    """Open the recording with this label in the list."""

    label: str

    def apply(self, workbench: Workbench) -> None:
        """Want it, unless it is open already."""
        opened = workbench.opened
        if opened is None or opened.entry.label != self.label:
            workbench.opening.request([self.label])


@dataclass(frozen=True)
class OpenFirst(LatestWins):
    """Open the first of these recordings that can be opened."""

    labels: tuple[str, ...]

    def apply(self, workbench: Workbench) -> None:
        """Want them."""
        workbench.opening.request(self.labels)


@dataclass(frozen=True)
class Restore(LatestWins):
    """Bring back a saved session in the recording that was opened for it."""

    saved: SavedSession

    def apply(self, workbench: Workbench) -> None:
        """Bring it back; in a recording that was opened instead there is nothing to restore."""
        if workbench.opened is not None and workbench.opened.entry.label == self.saved.label:
            workbench.restore(self.saved)


@dataclass(frozen=True)
class Move:
    """Go to a frame and then some frames on: one kind of command, so that both keep their order.

    Attributes:
        start: frame to go to first, None for the one that is shown; a number outside the
            recording means its first or last one.
        steps: frames to go from there, back where it is negative.
    """

    start: int | None = None
    steps: int = 0

    def merged_with(self, earlier: Self) -> Self:
        """Both; where this one names a frame, it does not matter what was before."""
        if self.start is not None:
            return self
        return type(self)(earlier.start, earlier.steps + self.steps)

    def apply(self, workbench: Workbench) -> None:
        """Go there."""
        if self.start is not None:
            workbench.seek(self.start)
        if self.steps:
            workbench.seek(workbench.frame + self.steps)


def seek(frame: int) -> Move:
    """Command to show this frame; a number outside the recording means its first or last one."""
    return Move(start=frame)


def step(frames: int) -> Move:
    """Command to go this many frames on, or back where it is negative."""
    return Move(steps=frames)


@dataclass(frozen=True)
class TogglePlay(Repeated):
    """Play where it stands still, and the other way round, this many times."""

    def apply(self, workbench: Workbench) -> None:
        """Play or pause."""
        if self.times % 2:
            workbench.toggle_play()


@dataclass(frozen=True)
class ChangeParameters:
    """Estimate with values of controls from now on.

    Attributes:
        values: {parameter: value}.
        at_end: those of them that are at an end of their slider, where the browser may have put
            them by itself.
    """

    values: Mapping[str, Any]
    at_end: frozenset[str] = frozenset()

    def merged_with(self, earlier: Self) -> Self:
        """Both changes, the later value of each parameter."""
        at_end = self.at_end | (earlier.at_end - self.values.keys())
        return type(self)({**earlier.values, **self.values}, at_end)

    def apply(self, workbench: Workbench) -> None:
        """Take the values, or refuse them."""
        workbench.tuning.enter(self.values, self.at_end, monotonic())


@dataclass(frozen=True)
class ResetParameters:
    """Put the parameters of these names back to what the app was started with."""

    names: frozenset[str]

    def merged_with(self, earlier: Self) -> Self:
        """Both of them."""
        return type(self)(earlier.names | self.names)

    def apply(self, workbench: Workbench) -> None:
        """Put them back."""
        workbench.tuning.reset(self.names)


@dataclass(frozen=True)
class ChangeView:
    """Draw with these settings, {name of the setting: value}, from now on."""

    values: Mapping[str, Any]

    def merged_with(self, earlier: Self) -> Self:
        """Both changes, the later value of each setting."""
        return type(self)({**earlier.values, **self.values})

    def apply(self, workbench: Workbench) -> None:
        """Draw so."""
        workbench.change_view(self.values)


@dataclass(frozen=True)
class ReceiveSurveyUpdate(Background, LatestWins):
    """Take note that the background has filled more of a survey."""

    news: SurveyUpdate

    def apply(self, workbench: Workbench) -> None:
        """Take note of it."""
        workbench.survey.receive(self.news)


@dataclass(frozen=True)
class ReceiveTaskEvents(Background):
    """Take note of how far background tasks are, and hand out their results."""

    events: tuple[TaskEvent, ...]

    def merged_with(self, earlier: Self) -> Self:
        """All of them, in their order."""
        return type(self)(earlier.events + self.events)

    def apply(self, workbench: Workbench) -> None:
        """Take note of them."""
        for event in self.events:
            workbench.outbox += workbench.tasks.receive(event)
