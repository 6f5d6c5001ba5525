"""Base class of the page's panels, which post commands and show snapshots."""

from collections.abc import Callable
from dataclasses import dataclass

import viser

from app.analysis.library import Opened
from app.browser.page_events import PageEvents
from app.scene.settings import ViewSettings
from app.session.command import Command
from app.session.snapshot import Snapshot, Status
from estimator import Parameters


@dataclass(frozen=True)
class PanelContext:
    """Arguments of a panel's constructor.

    Attributes:
        client: the browser client.
        parameters: initial ones.
        settings: initial ones.
        post: queues a command; thread-safe.
        events: of our own elements in the page.
    """

    client: viser.ClientHandle
    parameters: Parameters
    settings: ViewSettings
    post: Callable[[Command], None]
    events: PageEvents


class Panel:
    """Part of the page; its methods are called by the session's thread alone.

    The constructor adds controls, whose callbacks post commands.
    """

    def __init__(self, context: PanelContext) -> None:
        del context

    def open(self, opened: Opened) -> None:
        """Prepare for a newly opened recording, before its first snapshot."""

    def announce(self, status: Status) -> None:
        """Show state that need not wait for opening or estimating."""

    def show(self, snapshot: Snapshot) -> None:
        """Show the session's state after drawing; called after every possible change."""
