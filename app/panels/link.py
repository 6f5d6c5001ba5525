"""Link to the current state of a session."""

from dataclasses import dataclass

import viser

from app.panels.panel import Panel, PanelContext
from app.panels.triggers import post_on
from app.session.command import LatestWins
from app.session.outbox import LinkToCopy, Notice
from app.session.workbench import Workbench

_SENTENCE = (
    "The link leads to what this page shows now. It is in the clipboard; where the browser does "
    "not allow that, a box shows it for copying."
)


@dataclass(frozen=True)
class CopyLink(LatestWins):
    """Copy a link to what is shown."""

    def apply(self, workbench: Workbench) -> None:
        """Send the link and a notice to the browser."""
        if (saved := workbench.saved()) is not None:
            workbench.outbox += [
                LinkToCopy(saved.token()),
                Notice("Link", _SENTENCE, seconds=5.0),
            ]


class LinkPanel(Panel):
    """Button that copies a link."""

    def __init__(self, context: PanelContext) -> None:
        button = context.client.gui.add_button(
            "Copy link",
            icon=viser.Icon.LINK,
            hint="To what is shown: recording, frame, camera, view, picked cluster, and the "
            "parameters of A and B.",
        )
        entry = context.client.gui.add_command("Copy link", icon=viser.Icon.LINK)
        post_on(context.post, CopyLink(), button, entry)
