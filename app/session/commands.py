"""Commands posted by several panels or by the session; a panel's own are in its module."""

from collections.abc import Mapping
from dataclasses import dataclass
from time import monotonic
from typing import Any, Self

from app.analysis.catalogue import About
from app.errors import InputError
from app.session.command import Background, LatestOfEach, LatestWins, Repeated
from app.session.followed_survey import SurveyUpdate
from app.session.links import SavedSession
from app.session.outbox import Notice
from app.session.tasks import TaskEvent
from app.session.workbench import Workbench


@dataclass(frozen=True)
class OpenRecording(LatestWins):
    """Open the recording with this label in the list."""

    label: str

    def apply(self, workbench: Workbench) -> None:
        """Request it, unless it is open already."""
        opened = workbench.opened
        if opened is None or opened.entry.label != self.label:
            workbench.open_requests.request([self.label])


@dataclass(frozen=True)
class OpenFirst(LatestWins):
    """Open the first of these recordings that can be opened."""

    labels: tuple[str, ...]

    def apply(self, workbench: Workbench) -> None:
        """Request them."""
        workbench.open_requests.request(self.labels)


@dataclass(frozen=True)
class Restore(LatestWins):
    """Restore a saved session after its recording has been opened."""

    saved: SavedSession

    def apply(self, workbench: Workbench) -> None:
        """Restore it, unless another recording was opened instead."""
        if workbench.opened is not None and workbench.opened.entry.label == self.saved.label:
            workbench.restore(self.saved)


@dataclass(frozen=True)
class FollowEngine(LatestWins):
    """Draw with the engine that is now in use, and tell what there is to tell of it."""

    said: str

    def apply(self, workbench: Workbench) -> None:
        """Tell; the drawing that follows every command sees the engine."""
        if self.said:
            workbench.outbox.append(Notice("Estimator", self.said, seconds=60.0, replaces=True))


@dataclass(frozen=True)
class Move:
    """Seek and step; one kind of command, so that merging keeps their order.

    Attributes:
        start: frame to seek to, clipped to the recording; None for the current one.
        steps: frames to step from there, negative for backwards.
    """

    start: int | None = None
    steps: int = 0

    def merged_with(self, earlier: Self) -> Self:
        """This one if it seeks, else the earlier one with more steps."""
        if self.start is not None:
            return self
        return type(self)(earlier.start, earlier.steps + self.steps)

    def apply(self, workbench: Workbench) -> None:
        """Seek and step."""
        if self.start is not None:
            workbench.seek(self.start)
        if self.steps:
            workbench.seek(workbench.frame + self.steps)


def seek(frame: int) -> Move:
    """Command to seek to a frame, clipped to the recording."""
    return Move(start=frame)


def step(frames: int) -> Move:
    """Command to step this many frames, negative for backwards."""
    return Move(steps=frames)


@dataclass(frozen=True)
class TogglePlay(Repeated):
    """Toggle between play and pause, as often as posted."""

    def apply(self, workbench: Workbench) -> None:
        """Play or pause."""
        if self.times % 2:
            workbench.toggle_play()


@dataclass(frozen=True)
class ChangeParameters:
    """Change parameters to the values of controls.

    Attributes:
        values: {parameter: value}.
        ranges: {parameter: (smallest, largest)} of the controls.
    """

    values: Mapping[str, Any]
    ranges: Mapping[str, tuple[float, float]]

    def merged_with(self, earlier: Self) -> Self:
        """Both changes, the later value of each parameter."""
        return type(self)({**earlier.values, **self.values}, {**earlier.ranges, **self.ranges})

    def apply(self, workbench: Workbench) -> None:
        """Apply the values, or the nearest in their ranges."""
        workbench.tuning.enter(self.values, self.ranges, monotonic())


@dataclass(frozen=True)
class ResetParameters:
    """Reset these parameters to the values that the app was started with."""

    names: frozenset[str]

    def merged_with(self, earlier: Self) -> Self:
        """The names of both."""
        return type(self)(earlier.names | self.names)

    def apply(self, workbench: Workbench) -> None:
        """Reset them."""
        workbench.tuning.reset(self.names)


@dataclass(frozen=True)
class ChangeView(LatestOfEach):
    """Change settings of the drawing, {name: value}."""

    def apply(self, workbench: Workbench) -> None:
        """Redraw with them."""
        workbench.change_view(self.values)


@dataclass(frozen=True)
class Refuse(LatestWins):
    """Tell that what a control sent cannot be used, and why."""

    sentence: str

    def apply(self, workbench: Workbench) -> None:
        """Raise InputError."""
        raise InputError(self.sentence)


@dataclass(frozen=True)
class FollowSystem(LatestWins):
    """The system of the person at the page is dark or light now."""

    dark: bool

    def apply(self, workbench: Workbench) -> None:
        """Be as it is, unless a person chose by hand."""
        settings = workbench.settings
        if settings.follows_system and settings.dark != self.dark:
            workbench.change_view({"dark": self.dark, "follows_system": True})


@dataclass(frozen=True)
class ReceiveAbout(Background):
    """Receive what is in listed recordings, {label: what was found}."""

    found: Mapping[str, About]

    def merged_with(self, earlier: Self) -> Self:
        """Both, the later of each recording."""
        return type(self)({**earlier.found, **self.found})

    def apply(self, workbench: Workbench) -> None:
        """Pass it to the list."""
        workbench.choice.receive(self.found)


@dataclass(frozen=True)
class ReceiveSurveyUpdates(Background):
    """Receive updates of background surveys."""

    updates: tuple[SurveyUpdate, ...]

    def merged_with(self, earlier: Self) -> Self:
        """The last update of each survey."""
        again = [update.requested for update in self.updates]
        before = (u for u in earlier.updates if not any(u.requested is r for r in again))
        return type(self)((*before, *self.updates))

    def apply(self, workbench: Workbench) -> None:
        """Pass them to the session's surveys."""
        for update in self.updates:
            workbench.surveys.receive(update)


@dataclass(frozen=True)
class LookAgain(Background, LatestWins):
    """Show what a background thread has found since."""

    def apply(self, workbench: Workbench) -> None:
        """Change nothing: the snapshot that follows every command has what was found."""


@dataclass(frozen=True)
class ReceiveTaskEvents(Background):
    """Receive progress and results of background tasks."""

    events: tuple[TaskEvent, ...]

    def merged_with(self, earlier: Self) -> Self:
        """All events, in order."""
        return type(self)(earlier.events + self.events)

    def apply(self, workbench: Workbench) -> None:
        """Update the tasks, and put their results into the outbox."""
        for event in self.events:
            workbench.outbox += workbench.tasks.receive(event)
