"""Page of one browser client, with all panels."""

from collections.abc import Sequence

import viser

from app.analysis.library import Opened
from app.browser.fields import set_up_fields
from app.browser.opening_card import end_opening
from app.browser.script import (
    set_up_controls,
    set_up_keys,
    set_up_scene_edge,
    set_up_scripts,
    set_up_tabs,
    show_hints,
    window_width,
)
from app.panels.answers import AnswersPanel
from app.panels.compare import ComparePanel
from app.panels.corner_line import CornerLinePanel
from app.panels.delivery import Delivery
from app.panels.explain import ExplainPanel
from app.panels.export import ExportPanel
from app.panels.legend import LegendPanel
from app.panels.link import LinkPanel
from app.panels.offline_page import OfflinePagePanel
from app.panels.panel import Panel, PanelContext
from app.panels.parameters import MoreParametersPanel, ParametersPanel
from app.panels.plots import PlotsPanel
from app.panels.presets import PresetsPanel
from app.panels.recordings import RecordingsPanel
from app.panels.scene_note import SceneNotePanel
from app.panels.sensors import SensorsPanel
from app.panels.status import StatusPanel
from app.panels.system_theme import SystemTheme
from app.panels.timeline import TimelinePanel
from app.panels.view import ViewPanel
from app.session.snapshot import Snapshot, Status

TITLE = "Tofscope"

_Panels = tuple[type[Panel], ...]

_FIRST: _Panels = (RecordingsPanel, ParametersPanel)
"""Of the main panel, always in sight."""

_RIGHT: dict[str, _Panels] = {
    "Explain": (StatusPanel, ExplainPanel),
    "Compare": (ComparePanel,),
    "View": (ViewPanel,),
    "Export": (ExportPanel, OfflinePagePanel, LinkPanel),
    "More": (MoreParametersPanel, PresetsPanel),
}
"""{tab: its panels} below the main panel."""

_LEFT: dict[str, tuple[viser.IconName, _Panels]] = {
    "Plots": (viser.Icon.CHART_DOTS, (PlotsPanel,)),
    "Sensors": (viser.Icon.GRID_DOTS, (SensorsPanel,)),
}
"""{tab: its icon and its panels} on the other side of the scene."""

_OVER: _Panels = (
    TimelinePanel,
    LegendPanel,
    CornerLinePanel,
    SceneNotePanel,
    AnswersPanel,
    SystemTheme,
)
"""Outside viser's panels."""

_LEFT_WIDTH = 320  # pixels
_NARROW = 1340  # pixels; on pages up to this width the left panel starts folded


class Page:
    """All panels of a client."""

    def __init__(self, context: PanelContext) -> None:
        self._client = context.client
        self._opened: Opened | None = None
        self._title = ""
        set_up_scripts(context.client)
        set_up_controls(context.client)
        set_up_keys(context.client)
        set_up_fields(context.client)
        set_up_scene_edge(context.client)
        set_up_tabs(context.client)
        self._delivery = Delivery(context.client)
        self._context = context
        self._panels: list[Panel] = []
        self._add(_FIRST)
        self._add_right()
        self._add_left()
        self._add(_OVER)
        show_hints(context.client)

    def _add(self, panels: _Panels) -> None:
        self._panels += [panel(self._context) for panel in panels]

    def _add_right(self) -> None:
        gui = self._client.gui
        place = gui.add_panel()
        place.dock_below(gui.main_panel)
        for name, panels in _RIGHT.items():
            with place.add_tab(name):
                self._add(panels)

    def _add_left(self) -> None:
        place = self._client.gui.add_panel()
        place.dock_left()
        place.set_width(_LEFT_WIDTH)
        if window_width(self._client) <= _NARROW:
            place.minimize()
        for name, (icon, panels) in _LEFT.items():
            with place.add_tab(name, icon):
                self._add(panels)

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
            self._show_title(snapshot)
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

    def _show_title(self, snapshot: Snapshot) -> None:
        simulated = " (simulated)" if snapshot.opened.recording.simulated else ""
        edited = f": parameters of {snapshot.comparison.edited}" if snapshot.comparison else ""
        title = f"{TITLE}{simulated}{edited}"
        if title != self._title:
            self._title = title
            self._client.gui.set_panel_label(title)


def show_empty_page(client: viser.ClientHandle, folders: Sequence[str]) -> None:
    """Show instructions in place of panels if there is no recording."""
    end_opening(client)
    listed = "\n".join(f"- `{folder}`" for folder in folders)
    client.gui.add_markdown(
        f"**There is no recording here.**\n\nTofscope looked for `*.mcap` files in\n\n{listed}\n\n"
        "and in the folders below. "
        "Put a recording there and reload this page, or start `tofscope view` with the path of a "
        "recording, or without a path to see the samples."
    )
