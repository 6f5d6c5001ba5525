"""Legend over the scene."""

from app.browser.assets import ChangedCalls, run_asset
from app.panels.panel import Panel, PanelContext
from app.scene.legend_html import html
from app.session.snapshot import Snapshot


class LegendPanel(Panel):
    """Legend in the corner of the scene."""

    def __init__(self, context: PanelContext) -> None:
        self._calls = ChangedCalls(context.client, {"legend.show": ""})
        run_asset(context.client, "legend.js")

    def show(self, snapshot: Snapshot) -> None:
        """Show the legend of the current drawing."""
        content = html(snapshot.legend) if snapshot.settings.legend else ""
        self._calls.send("legend.show", content)
