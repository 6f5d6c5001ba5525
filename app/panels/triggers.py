"""Controls that post commands: buttons, entries of the command palette, choices."""

import reprlib
from collections.abc import Callable, Mapping
from typing import TypeVar

import viser

from app.session.command import Command
from app.session.commands import Refuse

Trigger = viser.GuiButtonHandle | viser.CommandHandle
T = TypeVar("T")


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


def post_chosen(
    post: Callable[[Command], None],
    control: viser.GuiDropdownHandle[str] | viser.GuiButtonGroupHandle,
    options: Mapping[str, T],
    command: Callable[[T], Command],
) -> None:
    """Post the command of the option that a control has; a browser may send others, too.

    Args:
        post: queues a command.
        control: with these options.
        options: {text: what it stands for}.
        command: of what it stands for.
    """
    value = str(control.value)
    if value in options:
        post(command(options[value]))
    else:
        known, sent = ", ".join(options), reprlib.repr(value)
        post(Refuse(f"{control.label} must be one of {known}, got {sent}."))
