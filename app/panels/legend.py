"""The legend that lies over the scene."""

import json

from app.browser.internals import run_script
from app.panels.panel import Panel, PanelContext
from app.scene.legend_html import html
from app.session.snapshot import Snapshot

# It is no part of viser's panels, so that it stays where these are folded away.
_SCRIPT = """
let legend = document.getElementById("tofscope-legend");
if (!legend) {
  legend = document.createElement("div");
  legend.id = "tofscope-legend";
  document.body.append(legend);
}
legend.innerHTML = %s;
"""


class LegendPanel(Panel):
    """Meaning of the colours, in the corner of the scene."""

    def __init__(self, context: PanelContext) -> None:
        self._client, self._said = context.client, ""

    def show(self, snapshot: Snapshot) -> None:
        """Say what the colours mean that are drawn now."""
        content = html(snapshot.legend) if snapshot.settings.legend else ""
        if content != self._said:
            self._said = content
            run_script(self._client, _SCRIPT % json.dumps(content))
