"""Commands that callbacks of the page post, and the session's thread applies."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol, Self

from app.session.workbench import Workbench


class Command(Protocol):
    """Frozen description of a change to a session's state; its class is its kind.

    It never touches a widget: panels show the next snapshot. Drawings and the camera are reached
    through the workbench's scene, one-time messages to the browser go into its outbox.
    """

    def merged_with(self, earlier: Self) -> Self:
        """Merge an `earlier` pending command and this one into one."""
        ...

    def apply(self, workbench: Workbench) -> None:
        """Change the state, in the session's thread; errors are shown to the user."""
        ...


@dataclass(frozen=True)
class LatestWins:
    """Command of which only the latest counts."""

    def merged_with(self, earlier: Self) -> Self:
        """Return this command, the later one."""
        return self


@dataclass(frozen=True)
class LatestOfEach:
    """Command that sets named values, of each of which only the latest counts.

    Attributes:
        values: {name: value}.
    """

    values: Mapping[str, Any]

    def merged_with(self, earlier: Self) -> Self:
        """Both changes, the later value of each name."""
        return type(self)({**earlier.values, **self.values})


class Background:
    """Internal command; its order relative to user commands is irrelevant."""


@dataclass(frozen=True)
class Repeated:
    """Command that counts as often as it was posted.

    Attributes:
        times: number of posts.
    """

    times: int = 1

    def merged_with(self, earlier: Self) -> Self:
        """Add up the posts."""
        return type(self)(earlier.times + self.times)
