"""Safe updates of controls that a user may be changing at the same moment."""

import asyncio
import threading
from typing import Any

import viser

from app.browser.internals import call_in_event_loop, send_value

_PATIENCE = 2.0  # seconds
_QUIET = 0.3  # seconds after the user's last change, so that typing is not disturbed


def show_value(control: viser.GuiInputHandle[Any], value: object) -> None:
    """Set a control's value in viser's event loop, without racing the user.

    viser assigns a user's value to the control and then calls back, both in its event loop. A value
    assigned in between by another thread would be read in place of the user's.

    Args:
        control: to set.
        value: of the control's type.
    """
    if control.value == value:
        return
    done = threading.Event()

    def assign() -> None:
        if "repeats" not in vars(control):
            vars(control)["repeats"] = _Repeats(control)
        control.value = value
        done.set()

    call_in_event_loop(control, assign)
    done.wait(_PATIENCE)


class _Repeats:
    """Repeated sending of a control's value to the page after the user's changes.

    A value on its way to the page may arrive there after the user has chosen another one. The page
    would go on showing the older value, while the session has the user's.
    """

    def __init__(self, control: viser.GuiInputHandle[Any]) -> None:
        self._pending: asyncio.TimerHandle | None = None

        @control.on_update
        async def _(event: viser.GuiEvent) -> None:
            if event.client_id is None:
                return
            if self._pending is not None:
                self._pending.cancel()
            loop = asyncio.get_running_loop()
            self._pending = loop.call_later(_QUIET, lambda: send_value(control))
