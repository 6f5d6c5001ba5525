"""A link to what is shown."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import viser

from app.browser.script import copy_link
from app.panels.panel import Desk, Panel
from app.session.commands import LatestWins

if TYPE_CHECKING:
    from app.session.workbench import Workbench


@dataclass(frozen=True)
class CopyLink(LatestWins):
    """Hand out a link that leads to what is shown."""

    def fulfil(self, workbench: "Workbench") -> None:
        """Give it to the browser's clipboard, or to the person where that is closed."""
        place = workbench.place()
        if place is not None:
            copy_link(workbench.client, place.token())
            workbench.client.add_notification(
                "Link",
                "To this recording, frame, camera and parameters. It is copied, or shown to be "
                "copied where the browser keeps its clipboard closed.",
                auto_close_seconds=5,
            )


class LinkPanel(Panel):
    """A button that copies a link."""

    def __init__(self, desk: Desk) -> None:
        button = desk.client.gui.add_button(
            "Copy link", icon=viser.Icon.LINK, hint="To recording, frame, camera and parameters."
        )
        command = desk.client.gui.add_command("Copy link", icon=viser.Icon.LINK)

        @button.on_click
        async def _(_: viser.GuiEvent) -> None:
            desk.post(CopyLink())

        @command.on_trigger
        async def _(_: viser.CommandEvent) -> None:
            desk.post(CopyLink())
