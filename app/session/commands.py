"""What a person can wish for in a session; a panel with wishes of its own defines them itself."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Self

from app.errors import InputError, UserError
from app.session.links import Place
from estimator import ParameterError

if TYPE_CHECKING:
    from app.session.workbench import Workbench


@dataclass(frozen=True)
class LatestWins:
    """Of several wishes of one kind the latest is the one that counts."""

    def after(self, earlier: Self) -> Self:
        """The latest of two wishes is the one that counts."""
        return self


@dataclass(frozen=True)
class OpenRecording(LatestWins):
    """Show the recording with this label in the list."""

    label: str

    def fulfil(self, workbench: "Workbench") -> None:
        """Open it."""
        workbench.open(self.label)


@dataclass(frozen=True)
class OpenAny(LatestWins):
    """Show the first of these recordings that can be opened."""

    labels: tuple[str, ...]

    def fulfil(self, workbench: "Workbench") -> None:
        """Open it; InputError says what was wrong with those before it."""
        problems: list[str] = []
        for label in self.labels:
            try:
                workbench.open(label)
                break
            except UserError as error:
                problems.append(str(error))
        if problems:
            more = f" {len(problems) - 1} more could not be opened." if len(problems) > 1 else ""
            raise InputError(problems[0] + more)


@dataclass(frozen=True)
class Arrive(LatestWins):
    """Show a place in the recording that has been opened for it."""

    place: Place

    def fulfil(self, workbench: "Workbench") -> None:
        """Go there; in a recording that was opened instead of it there is no such place."""
        if workbench.opened is not None and workbench.opened.entry.label == self.place.label:
            workbench.arrive(self.place)


@dataclass(frozen=True)
class Move:
    """Go to a frame and then some frames on: one kind of wish, so that its parts keep their order.

    Attributes:
        start: frame to go to first, None for the one that is shown; a number outside the
            recording means its first or last one.
        steps: frames to go from there, back where it is negative.
    """

    start: int | None = None
    steps: int = 0

    def after(self, earlier: Self) -> Self:
        """Both; where this one names a frame, it does not matter what was before."""
        if self.start is not None:
            return self
        return type(self)(earlier.start, earlier.steps + self.steps)

    def fulfil(self, workbench: "Workbench") -> None:
        """Go there."""
        if self.start is not None:
            workbench.seek(self.start)
        if self.steps:
            workbench.seek(workbench.frame + self.steps)


def seek(frame: int) -> Move:
    """Show this frame; a number outside the recording means its first or last one."""
    return Move(start=frame)


def step(frames: int) -> Move:
    """Go this many frames on, or back where it is negative."""
    return Move(steps=frames)


@dataclass(frozen=True)
class ResetParameters:
    """Put the parameters of these names back to what the app was started with."""

    names: frozenset[str]

    def after(self, earlier: Self) -> Self:
        """Both of them."""
        return type(self)(earlier.names | self.names)

    def fulfil(self, workbench: "Workbench") -> None:
        """Put them back."""
        values = {name: getattr(workbench.defaults, name) for name in self.names}
        workbench.set_parameters(replace(workbench.parameters, **values))


@dataclass(frozen=True)
class ChangeParameters:
    """Estimate with these values, {name of the parameter: value}, from now on."""

    values: Mapping[str, Any]

    def after(self, earlier: Self) -> Self:
        """Both changes, the later value of each parameter."""
        return type(self)({**earlier.values, **self.values})

    def fulfil(self, workbench: "Workbench") -> None:
        """Take them, or say why not."""
        panel = workbench.page.parameters
        values = panel.meant(self.values, workbench.parameters)
        if not values:
            return
        try:
            workbench.change_parameters(values)
        except ParameterError as error:
            panel.refuse(values, str(error))
        else:
            panel.accept(workbench.parameters)


@dataclass(frozen=True)
class ChangeView:
    """Draw with these settings, {name of the setting: value}, from now on."""

    values: Mapping[str, Any]

    def after(self, earlier: Self) -> Self:
        """Both changes, the later value of each setting."""
        return type(self)({**earlier.values, **self.values})

    def fulfil(self, workbench: "Workbench") -> None:
        """Draw so."""
        workbench.change_view(self.values)


@dataclass(frozen=True)
class TogglePlay:
    """Play where it stands still, and the other way round, this many times."""

    times: int = 1

    def after(self, earlier: Self) -> Self:
        """All the times."""
        return type(self)(earlier.times + self.times)

    def fulfil(self, workbench: "Workbench") -> None:
        """Play or pause."""
        if self.times % 2:
            workbench.toggle_play()


@dataclass(frozen=True)
class Look(LatestWins):
    """Put the camera to the view of this name."""

    view: str

    def fulfil(self, workbench: "Workbench") -> None:
        """Put it there."""
        workbench.look(self.view)


@dataclass(frozen=True)
class CameraMoved(LatestWins):
    """The camera has come nearer or gone away, or its picture has got another shape."""

    def fulfil(self, workbench: "Workbench") -> None:
        """Draw in sizes that suit it."""
        workbench.focus()
