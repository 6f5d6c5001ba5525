"""List of recordings, and a description of the open one."""

from collections.abc import Sequence
from html import escape

import viser

from app.analysis.library import Opened
from app.browser.controls import show_value
from app.panels.panel import Panel, PanelContext
from app.session.commands import OpenRecording
from app.session.snapshot import Snapshot, Status

_LINES = 3  # of the longest description


class RecordingsPanel(Panel):
    """List to open a recording from."""

    def __init__(self, context: PanelContext) -> None:
        gui, post = context.client.gui, context.post
        labels = tuple(entry.label for entry in context.entries)
        self._list = gui.add_dropdown(
            "Recording", labels, hint="The recordings of the opened files and folders."
        )
        self._shown: Opened | None = None
        self._about = gui.add_html(_lines(["Opening …"]))

        @self._list.on_update
        async def _(event: viser.GuiEvent) -> None:
            if event.client_id is not None:
                post(OpenRecording(self._list.value))

    def announce(self, status: Status) -> None:
        """Say what is being opened, until the first of it is shown, or that nothing is open."""
        opened, opening = status.opened, status.opening
        if opening is None and opened is not None and opened is not self._shown:
            opening = opened.entry.label
        if opening is not None:
            self._about.content = _lines([f"Opening {opening} …"])
        else:
            self._about.content = _lines(describe(opened) if opened else ["No recording is open."])

    def show(self, snapshot: Snapshot) -> None:
        """Describe and choose what is open, also after a recording that could not be opened."""
        self._shown = snapshot.opened
        self._about.content = _lines(describe(snapshot.opened))
        show_value(self._list, snapshot.opened.entry.label)


def describe(opened: Opened) -> list[str]:
    """Describe size and origin of a recording in short lines."""
    recording = opened.recording
    lines: list[str] = []
    provenance = recording.provenance
    if provenance and recording.simulated:
        lines.append(f"Simulated: {provenance.experiment}")
    seconds = recording.stamps[-1] - recording.stamps[0] if len(recording) else 0.0
    count = len(recording.sensors)
    sensors = "1 sensor" if count == 1 else f"{count} sensors"
    frames = "1 frame" if len(recording) == 1 else f"{len(recording)} frames"
    lines.append(f"{sensors}, {frames}, {seconds:.1f} s")
    lines.append(f"Fixed frame: {recording.fixed_frame}")
    return lines


def _lines(said: Sequence[str]) -> str:
    lines = "".join(f"<div>{escape(text)}</div>" for text in said)
    # As high with one line as with three, so that the controls below stay in place.
    style = f"font-size: 0.75rem; line-height: 1.2rem; min-height: {1.2 * _LINES}rem"
    return f'<div style="{style}; padding: 0 1em; opacity: 0.75">{lines}</div>'
