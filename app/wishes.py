"""What a person can wish for in a session."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self


@dataclass(frozen=True)
class _LatestWins:
    def after(self, earlier: Self) -> Self:
        """The latest of two wishes is the one that counts."""
        return self


@dataclass(frozen=True)
class OpenRecording(_LatestWins):
    """Show the recording with this label in the list."""

    label: str


@dataclass(frozen=True)
class Seek(_LatestWins):
    """Show this frame; a number outside the recording means its first or last one."""

    frame: int


@dataclass(frozen=True)
class ResetParameters(_LatestWins):
    """Estimate with the parameters that the app was started with from now on."""


@dataclass(frozen=True)
class SaveParameters(_LatestWins):
    """Save the parameters as a file that the command line takes."""


@dataclass(frozen=True)
class TakeScreenshot(_LatestWins):
    """Save what the page shows as a PNG file."""


@dataclass(frozen=True)
class ChangeParameters:
    """Estimate with these values, {name of the parameter: value}, from now on."""

    values: Mapping[str, Any]

    def after(self, earlier: Self) -> Self:
        """Both changes, the later value of each parameter."""
        return type(self)({**earlier.values, **self.values})


@dataclass(frozen=True)
class ChangeView:
    """Draw with these settings, {name of the setting: value}, from now on."""

    values: Mapping[str, Any]

    def after(self, earlier: Self) -> Self:
        """Both changes, the later value of each setting."""
        return type(self)({**earlier.values, **self.values})


@dataclass(frozen=True)
class Step:
    """Go this many frames on, or back where it is negative."""

    frames: int

    def after(self, earlier: Self) -> Self:
        """Both steps."""
        return type(self)(earlier.frames + self.frames)


@dataclass(frozen=True)
class TogglePlay:
    """Play where it stands still, and the other way round, this many times."""

    times: int = 1

    def after(self, earlier: Self) -> Self:
        """All the times."""
        return type(self)(earlier.times + self.times)
