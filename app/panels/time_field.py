"""Field that shows the current time and seeks to a typed one."""

import math
import time
from dataclasses import dataclass

import numpy as np
import viser

from app.analysis.library import Opened
from app.browser.controls import show_value
from app.browser.internals import element_id
from app.panels.panel import PanelContext
from app.session.command import LatestWins
from app.session.snapshot import Snapshot, TimeSeek
from app.session.workbench import Workbench

_TYPING = 2.0  # seconds for which a typed time is kept during playback


@dataclass(frozen=True)
class SeekTime(LatestWins):
    """Seek to the frame nearest to this time, in seconds from the start."""

    seconds: float

    def apply(self, workbench: Workbench) -> None:
        """Seek, and record the seek."""
        if workbench.opened is not None:
            stamps = workbench.opened.recording.stamps
            workbench.seek(int(np.argmin(np.abs(stamps - stamps[0] - self.seconds))))
            workbench.time_seek = TimeSeek(self.seconds, workbench.frame)


class TimeField:
    """Field that shows the current frame's time unless the user is typing; part of a panel.

    Attributes:
        field: id of its element in the page.
    """

    def __init__(self, context: PanelContext) -> None:
        self._typed: float | None = None  # a typed time to which the session has not yet sought
        self._typed_at = -_TYPING
        self._last_seek: TimeSeek | None = None
        self._kept_frame: int | None = None  # frame at which the typed time is kept in the field
        self._control = context.client.gui.add_number(
            "Go to [s]",
            0.0,
            min=0.0,
            step=0.001,
            hint="Seconds from the start; a click in a plot goes there, too.",
        )
        self.field = element_id(self._control)

        # Coroutines run at once, before the control's value can change again.
        @self._control.on_update
        async def _(event: viser.GuiEvent) -> None:
            if event.client_id is not None:
                self._typed, self._typed_at = self._control.value, time.monotonic()
                context.post(SeekTime(self._control.value))

    def open(self, opened: Opened) -> None:
        """Set the range to the recording's duration."""
        self._typed = self._kept_frame = None
        end = float(opened.recording.stamps[-1] - opened.recording.stamps[0])
        self._control.max = math.ceil(1e3 * end) / 1e3

    def show(self, snapshot: Snapshot) -> None:
        """Show the frame's time; a typed time is kept until another frame is shown."""
        time_seek = snapshot.time_seek
        if time_seek is not None and time_seek is not self._last_seek:
            self._kept_frame = time_seek.frame
            if time_seek.seconds == self._typed:
                self._typed = None
        self._last_seek = time_seek
        typing = snapshot.playing and time.monotonic() < self._typed_at + _TYPING
        if typing or self._typed is not None or snapshot.frame == self._kept_frame:
            return
        self._kept_frame = None
        stamps = snapshot.opened.recording.stamps
        show_value(self._control, round(float(stamps[snapshot.frame] - stamps[0]), 3))
