"""The legend that lies over the scene."""

import json

from app.browser.script import run
from app.panels.panel import Desk, Panel, Shown
from app.scene.legend_html import html

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
    """Says what the colours mean, in the corner of the scene."""

    def __init__(self, desk: Desk) -> None:
        self._client, self._said = desk.client, ""

    def show(self, shown: Shown) -> None:
        """Say it of what is drawn now."""
        content = html(shown.legend) if shown.settings.legend else ""
        if content != self._said:
            self._said = content
            run(self._client, _SCRIPT % json.dumps(content))
