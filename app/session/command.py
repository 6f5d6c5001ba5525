"""Commands: what callbacks of the page post, and the session's thread applies."""

from dataclasses import dataclass
from typing import Protocol, Self

from app.session.workbench import Workbench


class Command(Protocol):
    """Frozen data and an intent on a session's state; its class is its kind.

    It never touches a widget, the page or the client: what the page is to show, it reads from the
    next snapshot, and what is to be handed to the browser once goes into the workbench's outbox.
    """

    def merged_with(self, earlier: Self) -> Self:
        """The one command that stands for an `earlier` one, not yet applied, and this one."""
        ...

    def apply(self, workbench: Workbench) -> None:
        """Change the state, in the session's thread; what it raises is told to the person."""
        ...


@dataclass(frozen=True)
class LatestWins:
    """Command of which the latest alone counts."""

    def merged_with(self, earlier: Self) -> Self:
        """The latest of the two."""
        return self


class Background:
    """Command that no person gives and whose place among theirs does not matter.

    Such commands may come in between a person's at any rate.
    """


@dataclass(frozen=True)
class Repeated:
    """Command that counts as often as it was posted.

    Attributes:
        times: it was.
    """

    times: int = 1

    def merged_with(self, earlier: Self) -> Self:
        """All the times."""
        return type(self)(earlier.times + self.times)
