"""Buttons and entries of the command palette that post a command."""

from collections.abc import Callable

import viser

from app.session.command import Command

Trigger = viser.GuiButtonHandle | viser.CommandHandle


def post_on(post: Callable[[Command], None], command: Command, *triggers: Trigger) -> None:
    """Post a command whenever one of the buttons or palette entries is used."""

    # A coroutine runs at once, so that commands keep their order.
    async def posted(_: viser.GuiEvent | viser.CommandEvent) -> None:
        post(command)

    for trigger in triggers:
        if isinstance(trigger, viser.CommandHandle):
            trigger.on_trigger(posted)
        else:
            trigger.on_click(posted)
