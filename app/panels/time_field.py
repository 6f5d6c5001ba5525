"""A field with the time that is shown, in which another may be typed."""

import math
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import viser

from app.analysis.library import Opened
from app.browser.controls import show_value
from app.panels.panel import Desk, Shown
from app.session.commands import LatestWins

if TYPE_CHECKING:
    from app.session.workbench import Workbench

_TYPING = 2.0  # seconds for which a typed time stays, also while the recording is played


@dataclass(frozen=True)
class SeekTime(LatestWins):
    """Go to the frame that is nearest to this time, in seconds from the start."""

    field: "TimeField"
    seconds: float

    def fulfil(self, workbench: "Workbench") -> None:
        """Go there."""
        if workbench.opened is not None:
            stamps = workbench.opened.recording.stamps
            workbench.seek(int(np.argmin(np.abs(stamps - stamps[0] - self.seconds))))
            self.field.arrived(self.seconds, workbench.frame)


class TimeField:
    """Follows the frame that is shown, unless a person is typing; part of a panel.

    Attributes:
        field: its id in the page.
    """

    def __init__(self, desk: Desk) -> None:
        self._typed: float | None = None  # a time that the session has not gone to yet
        self._typed_at = -_TYPING
        self._stays_at: int | None = None  # the frame that a typed time has led to
        self._control = desk.client.gui.add_number(
            "Go to [s]",
            0.0,
            min=0.0,
            step=0.001,
            hint="Seconds from the start; a click in a plot goes there, too.",
        )
        self.field = self._control._impl.uuid

        # Coroutines run at once, before anything can change a control's value again.
        @self._control.on_update
        async def _(event: viser.GuiEvent) -> None:
            if event.client_id is not None:
                self._typed, self._typed_at = self._control.value, time.monotonic()
                desk.post(SeekTime(self, self._control.value))

    def open(self, opened: Opened) -> None:
        """Prepare for a recording's time."""
        self._typed = self._stays_at = None
        end = float(opened.recording.stamps[-1] - opened.recording.stamps[0])
        self._control.max = math.ceil(1e3 * end) / 1e3

    def arrived(self, seconds: float, frame: int) -> None:
        """Take note that a typed time has led to a frame; what is typed stays until that is left.

        Args:
            seconds: what was typed.
            frame: where it led.
        """
        self._stays_at = frame
        if seconds == self._typed:
            self._typed = None

    def show(self, shown: Shown) -> None:
        """Show the frame's time."""
        typing = shown.playing and time.monotonic() < self._typed_at + _TYPING
        if typing or self._typed is not None or shown.frame == self._stays_at:
            return
        self._stays_at = None
        stamps = shown.opened.recording.stamps
        show_value(self._control, round(float(stamps[shown.frame] - stamps[0]), 3))
