"""The page of one browser client: its panels, in their order."""

from collections.abc import Sequence

import viser

from app.analysis.library import Opened
from app.browser.fields import set_up_fields
from app.browser.script import set_up_keys, set_up_scene_edge
from app.panels.compare import ComparePanel
from app.panels.explain import ExplainPanel
from app.panels.legend import LegendPanel
from app.panels.link import LinkPanel
from app.panels.offline_page import OfflinePagePanel
from app.panels.panel import Desk, Panel, Shown
from app.panels.parameters import ParametersPanel
from app.panels.playback import PlaybackPanel
from app.panels.plots import PlotsPanel
from app.panels.presets import PresetsPanel
from app.panels.recordings import RecordingsPanel
from app.panels.screenshot import ScreenshotPanel
from app.panels.status import StatusPanel
from app.panels.view import ViewPanel

TITLE = "Tofscope"


class Page:
    """All panels of a client, from top to bottom.

    Attributes:
        recordings: the panel that says what is open, or being opened.
        parameters: the panel that changes of parameters are accepted and refused in.
    """

    def __init__(self, desk: Desk) -> None:
        self._client = desk.client
        self._said: dict[str, viser.NotificationHandle] = {}
        set_up_keys(desk.client)
        set_up_fields(desk.client)
        set_up_scene_edge(desk.client)
        self.recordings = RecordingsPanel(desk)
        self._panels: list[Panel] = [
            self.recordings,
            PlaybackPanel(desk),
            StatusPanel(desk),
        ]
        self.parameters = ParametersPanel(desk)
        self._panels += [
            self.parameters,
            PresetsPanel(desk),
            ExplainPanel(desk),
            ComparePanel(desk),
            ViewPanel(desk),
            ScreenshotPanel(desk),
            OfflinePagePanel(desk),
            LegendPanel(desk),
            LinkPanel(desk),
            PlotsPanel(desk),
        ]

    def open(self, opened: Opened) -> None:
        """Prepare for a recording that was opened, and say what could not be used of it."""
        recording, label = opened.recording, opened.entry.label
        for panel in self._panels:
            panel.open(opened)
        self._client.gui.set_panel_label(f"{TITLE} (simulated)" if recording.simulated else TITLE)
        for warning in recording.warnings:
            self._client.add_notification(label, warning, color="yellow", auto_close_seconds=15)

    def show(self, shown: Shown) -> None:
        """Show what the session shows."""
        for panel in self._panels:
            panel.show(shown)

    def say(self, title: str, sentence: str) -> None:
        """Tell a person something, in the place of what was said under this title before."""
        if (before := self._said.get(title)) is not None:
            before.remove()
        self._said[title] = self._client.add_notification(title, sentence, auto_close_seconds=6)

    def leave(self) -> None:
        """End what is done for the client, which has gone."""
        for panel in self._panels:
            panel.leave()

    def close(self) -> None:
        """Let go of the recording, which is about to be closed."""
        for panel in self._panels:
            panel.close()


def show_empty_page(client: viser.ClientHandle, folders: Sequence[str]) -> None:
    """Say what to do where there is nothing to open."""
    places = "\n".join(f"- `{folder}`" for folder in folders)
    client.gui.add_markdown(
        f"**There is no recording here.**\n\nTofscope looked for `*.mcap` files in\n\n{places}\n\n"
        "Put a recording there and reload this page, or start `tofscope view` with the path of a "
        "recording, or without a path to see the samples."
    )
