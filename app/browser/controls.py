"""Safe updates of controls that a user may be changing at the same moment."""

import threading
from typing import Any

import viser

from app.browser.internals import call_in_event_loop

_PATIENCE = 2.0  # seconds


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
        control.value = value
        done.set()

    call_in_event_loop(control, assign)
    done.wait(_PATIENCE)
