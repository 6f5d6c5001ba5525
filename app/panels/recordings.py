"""The list of recordings, and what is known of the one that is open."""

from collections.abc import Iterator
from contextlib import contextmanager
from html import escape

import viser

from app.analysis.library import Opened
from app.browser.controls import show_value
from app.panels.panel import Desk, Panel, Shown
from app.session.commands import OpenRecording


class RecordingsPanel(Panel):
    """Choose a recording."""

    def __init__(self, desk: Desk) -> None:
        gui, post = desk.client.gui, desk.post
        labels = tuple(entry.label for entry in desk.entries)
        self._list = gui.add_dropdown(
            "Recording", labels, hint="The recordings of the opened files and folders."
        )
        self._about = gui.add_html(_line("Opening …"))

        @self._list.on_update
        async def _(event: viser.GuiEvent) -> None:
            if event.client_id is not None:
                post(OpenRecording(self._list.value))

    @contextmanager
    def opening(self, label: str, before: Opened | None) -> Iterator[None]:
        """Say that a recording is being opened, which may take a while.

        Args:
            label: of the recording.
            before: what is open, and stays open if the other cannot be opened.
        """
        self._about.content = _line(f"Opening {escape(label)} …")
        try:
            yield
        except Exception:
            self._about.content = _line("No recording is open.")
            if before is not None:
                self.open(before)
            raise

    def open(self, opened: Opened) -> None:
        """Say what is open."""
        self._about.content = "".join(_line(escape(text)) for text in describe(opened))

    def show(self, shown: Shown) -> None:
        """Choose what is open, also after a recording that could not be opened."""
        show_value(self._list, shown.opened.entry.label)


def describe(opened: Opened) -> list[str]:
    """What a person should know of a recording, in a few short lines."""
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
