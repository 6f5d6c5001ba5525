"""Legend over the scene."""

import json

from app.browser.internals import run_script
from app.panels.panel import Panel, PanelContext
from app.scene.legend_html import html
from app.session.snapshot import Snapshot

# Outside viser's panels, so that it stays visible when these are folded.
_SCRIPT = """
let legend = document.getElementById("tofscope-legend");
if (!legend) {
  legend = document.createElement("div");
  legend.id = "tofscope-legend";
  document.body.append(legend);
}
legend.innerHTML = %s;
const height = legend.firstElementChild?.offsetHeight ?? 0;
document.documentElement.style.setProperty("--legend-height", `${height}px`);
"""


class LegendPanel(Panel):
    """Legend in the corner of the scene."""

    def __init__(self, context: PanelContext) -> None:
        self._client, self._shown = context.client, ""

    def show(self, snapshot: Snapshot) -> None:
        """Show the legend of the current drawing."""
        content = html(snapshot.legend) if snapshot.settings.legend else ""
        if content != self._shown:
            self._shown = content
            run_script(self._client, _SCRIPT % json.dumps(content))
