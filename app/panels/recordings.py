"""The list of recordings, and what is known of the one that is open."""

from collections.abc import Callable, Sequence
from html import escape

import viser

from app.library import Entry, Opened
from app.wishes import OpenRecording


class RecordingsPanel:
    """Choose a recording.

    Args:
        gui: of the client.
        entries: what can be chosen, at least one.
        post: takes wishes.
    """

    def __init__(
        self, gui: viser.GuiApi, entries: Sequence[Entry], post: Callable[[OpenRecording], None]
    ) -> None:
        labels = tuple(entry.label for entry in entries)
        self._list = gui.add_dropdown(
            "Recording", labels, hint="The recordings of the opened files and folders."
        )
        self._about = gui.add_html("")

        @self._list.on_update
        async def _(event: viser.GuiEvent) -> None:
            if event.client_id is not None:
                post(OpenRecording(self._list.value))

    def show(self, opened: Opened | None) -> None:
        """Show what is open, None for nothing."""
        if opened is None:
            self._about.content = _line("No recording is open.")
            return
        self._list.value = opened.entry.label
        self._about.content = "".join(_line(escape(text)) for text in describe(opened))


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
    lines.append(f"{sensors}, {len(recording)} frames, {seconds:.1f} s")
    lines.append(f"Fixed frame: {recording.fixed_frame}")
    return lines


def _line(text: str) -> str:
    return f'<div style="font-size: 0.75rem; padding: 0 1em; opacity: 0.75">{text}</div>'
