"""Legend over the scene."""

from app.browser.assets import call, run_asset
from app.panels.panel import Panel, PanelContext
from app.scene.legend_html import html
from app.session.snapshot import Snapshot


class LegendPanel(Panel):
    """Legend in the corner of the scene."""

    def __init__(self, context: PanelContext) -> None:
        self._client, self._shown = context.client, ""
        run_asset(self._client, "legend.js")

    def show(self, snapshot: Snapshot) -> None:
        """Show the legend of the current drawing."""
        content = html(snapshot.legend) if snapshot.settings.legend else ""
        if content != self._shown:
            self._shown = content
            call(self._client, "legend.show", content)
