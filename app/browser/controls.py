"""Values that a session shows in controls which a person may be using at the same moment."""

import threading
from typing import Any

import viser

from app.browser.internals import call_in_event_loop

_PATIENCE = 2.0  # seconds


def show_value(control: viser.GuiInputHandle[Any], value: object) -> None:
    """Let a control show a value.

    viser puts what a person chose into the control and then calls back, in the thread of its event
    loop. A value that came in between from another thread would be read instead of the person's.

    Args:
        control: of a session's page.
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
