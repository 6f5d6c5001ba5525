"""Base of the page's panels: each posts commands, and shows the session's snapshot."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import viser

from app.analysis.library import Entry, Opened
from app.scene.settings import ViewSettings
from app.session.command import Command
from app.session.snapshot import Snapshot, Status
from estimator import Parameters


@dataclass(frozen=True)
class PanelContext:
    """Surroundings that a panel is made in.

    Attributes:
        client: the browser client.
        entries: recordings to choose from, at least one.
        parameters: to begin with.
        settings: to begin with.
        post: takes commands, from any thread.
    """

    client: viser.ClientHandle
    entries: Sequence[Entry]
    parameters: Parameters
    settings: ViewSettings
    post: Callable[[Command], None]


class Panel:
    """Part of the page. Its methods are called by the session's thread alone.

    A panel adds its controls when it is made, and posts commands from their callbacks.
    """

    def __init__(self, context: PanelContext) -> None:
        del context

    def open(self, opened: Opened) -> None:
        """Prepare for a recording that was opened, before anything of it is shown."""

    def announce(self, status: Status) -> None:
        """Show what needs not wait until a recording is opened or a frame is estimated."""

    def show(self, snapshot: Snapshot) -> None:
        """Show the session's state after drawing; called whenever it may have changed."""
