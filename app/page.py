"""The page of one browser client: its panels, in their order."""

from collections.abc import Callable, Sequence

import viser

from app.library import Entry, Opened
from app.mailbox import Wish
from app.panels.parameters import ParametersPanel
from app.panels.playback import PlaybackPanel
from app.panels.recordings import RecordingsPanel
from app.panels.screenshot import ScreenshotPanel
from app.panels.status import StatusPanel
from app.panels.view import ViewPanel
from app.scene.scene import ViewSettings
from estimator import Parameters

TITLE = "Tofscope"


class Page:
    """All panels of a client.

    Args:
        client: the browser client.
        entries: recordings to choose from, at least one.
        parameters: to begin with.
        settings: to begin with.
        post: takes wishes, from any thread.
    """

    def __init__(
        self,
        client: viser.ClientHandle,
        entries: Sequence[Entry],
        parameters: Parameters,
        settings: ViewSettings,
        post: Callable[[Wish], None],
    ) -> None:
        self._client = client
        self.recordings = RecordingsPanel(client.gui, entries, post)
        self.playback = PlaybackPanel(client.gui, post)
        self.status = StatusPanel(client.gui)
        self.parameters = ParametersPanel(client.gui, parameters, post)
        self.view = ViewPanel(client.gui, settings, post)
        self.screenshot = ScreenshotPanel(client, post)

    def open(self, opened: Opened) -> None:
        """Show which recording is open, and what could not be used of it."""
        recording, label = opened.recording, opened.entry.label
        self.recordings.show(opened)
        self.playback.open(len(recording))
        self._client.gui.set_panel_label(f"{TITLE} (simulated)" if recording.simulated else TITLE)
        for warning in recording.warnings:
            self._client.add_notification(label, warning, color="yellow", auto_close_seconds=15)


def show_empty_page(client: viser.ClientHandle, folders: Sequence[str]) -> None:
    """Say what to do where there is nothing to open."""
    places = "\n".join(f"- `{folder}`" for folder in folders)
    client.gui.add_markdown(
        f"**There is no recording here.**\n\nTofscope looked for `*.mcap` files in\n\n{places}\n\n"
        "Put a recording there and reload this page, or start `tofscope view` with the path of a "
        "recording, or without a path to see the samples."
    )
