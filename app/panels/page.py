"""Page of one browser client, with all panels."""

from collections.abc import Sequence

import viser

from app.analysis.library import Opened
from app.browser.fields import set_up_fields
from app.browser.script import set_up_controls, set_up_keys, set_up_scene_edge
from app.panels.compare import ComparePanel
from app.panels.delivery import Delivery
from app.panels.explain import ExplainPanel
from app.panels.legend import LegendPanel
from app.panels.link import LinkPanel
from app.panels.offline_page import OfflinePagePanel
from app.panels.panel import Panel, PanelContext
from app.panels.parameters import ParametersPanel
from app.panels.playback import PlaybackPanel
from app.panels.plots import PlotsPanel
from app.panels.presets import PresetsPanel
from app.panels.recordings import RecordingsPanel
from app.panels.screenshot import ScreenshotPanel
from app.panels.status import StatusPanel
from app.panels.view import ViewPanel
from app.session.snapshot import Snapshot, Status

TITLE = "Tofscope"

_PANELS = (
    RecordingsPanel,
    PlaybackPanel,
    StatusPanel,
    ParametersPanel,
    PresetsPanel,
    ExplainPanel,
    ComparePanel,
    ViewPanel,
    ScreenshotPanel,
    OfflinePagePanel,
    LegendPanel,
    LinkPanel,
    PlotsPanel,
)
"""All panels, from top to bottom."""


class Page:
    """All panels of a client."""

    def __init__(self, context: PanelContext) -> None:
        self._client = context.client
        self._opened: Opened | None = None
        set_up_controls(context.client)
        set_up_keys(context.client)
        set_up_fields(context.client)
        set_up_scene_edge(context.client)
        self._delivery = Delivery(context.client)
        self._panels: list[Panel] = [panel(context) for panel in _PANELS]

    def announce(self, status: Status) -> None:
        """Show state that needs no drawing, and send messages to the browser."""
        try:
            for panel in self._panels:
                panel.announce(status)
        finally:
            # Messages refer to the state, which is shown first.
            self._deliver(status)

    def show(self, snapshot: Snapshot) -> None:
        """Show the state after drawing, and send messages to the browser."""
        try:
            if snapshot.opened is not self._opened:
                self._open(snapshot.opened)
            for panel in self._panels:
                panel.show(snapshot)
        finally:
            self._deliver(snapshot)

    def _deliver(self, status: Status) -> None:
        self._delivery.deliver(status.outbox)
        self._delivery.show_tasks(status.tasks)

    def _open(self, opened: Opened) -> None:
        self._opened = opened
        for panel in self._panels:
            panel.open(opened)
        simulated = opened.recording.simulated
        self._client.gui.set_panel_label(f"{TITLE} (simulated)" if simulated else TITLE)


def show_empty_page(client: viser.ClientHandle, folders: Sequence[str]) -> None:
    """Show instructions in place of panels if there is no recording."""
    listed = "\n".join(f"- `{folder}`" for folder in folders)
    client.gui.add_markdown(
        f"**There is no recording here.**\n\nTofscope looked for `*.mcap` files in\n\n{listed}\n\n"
        "Put a recording there and reload this page, or start `tofscope view` with the path of a "
        "recording, or without a path to see the samples."
    )
