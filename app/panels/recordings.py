"""List of recordings, and a description of the open one."""

from html import escape

import viser

from app.analysis.library import Opened
from app.browser.controls import show_value
from app.panels.panel import Panel, PanelContext
from app.session.commands import OpenRecording
from app.session.snapshot import Snapshot, Status


class RecordingsPanel(Panel):
    """List to open a recording from."""

    def __init__(self, context: PanelContext) -> None:
        gui, post = context.client.gui, context.post
        labels = tuple(entry.label for entry in context.entries)
        self._list = gui.add_dropdown(
            "Recording", labels, hint="The recordings of the opened files and folders."
        )
        self._about = gui.add_html(_line("Opening …"))

        @self._list.on_update
        async def _(event: viser.GuiEvent) -> None:
            if event.client_id is not None:
                post(OpenRecording(self._list.value))

    def announce(self, status: Status) -> None:
        """Show which recording is being opened or is open."""
        if status.opening is not None:
            texts = [f"Opening {status.opening} …"]
        else:
            texts = describe(status.opened) if status.opened else ["No recording is open."]
        self._about.content = "".join(_line(escape(text)) for text in texts)

    def show(self, snapshot: Snapshot) -> None:
        """Select the open recording, also after another failed to open."""
        show_value(self._list, snapshot.opened.entry.label)


def describe(opened: Opened) -> list[str]:
    """Describe size and origin of a recording in short lines."""
    recording = opened.recording
    lines: list[str] = []
    provenance = recording.provenance
    if provenance and recording.simulated:
        lines.append(
            f"Simulated: {provenance.scenario}, {provenance.speed:g} m/s, trial {provenance.trial}"
        )
    seconds = recording.stamps[-1] - recording.stamps[0] if len(recording) else 0.0
    count = len(recording.sensors)
    sensors = "1 sensor" if count == 1 else f"{count} sensors"
    frames = "1 frame" if len(recording) == 1 else f"{len(recording)} frames"
    lines.append(f"{sensors}, {frames}, {seconds:.1f} s")
    lines.append(f"Fixed frame: {recording.fixed_frame}")
    return lines


def _line(text: str) -> str:
    return f'<div style="font-size: 0.75rem; padding: 0 1em; opacity: 0.75">{text}</div>'
