"""Line in the corner of the scene, with a scale bar."""

from app.browser.assets import ChangedCalls, run_asset
from app.panels.panel import Panel, PanelContext
from app.scene.corner_line import corner_parts
from app.session.snapshot import Snapshot


class CornerLinePanel(Panel):
    """What is drawn, in one line, and how large it is; shown together with the legend."""

    def __init__(self, context: PanelContext) -> None:
        self._calls = ChangedCalls(context.client)
        run_asset(context.client, "corner_line.css")
        run_asset(context.client, "corner_line.js")

    def show(self, snapshot: Snapshot) -> None:
        """Show the line of the current drawing, and the scale of the current camera."""
        self._calls.send("corner.show", _content(snapshot))


def _content(snapshot: Snapshot) -> dict[str, object]:
    parts: tuple[str, ...] = ()
    if snapshot.settings.legend:
        parameters, compared = snapshot.parameters, snapshot.comparison
        parts = corner_parts(
            snapshot.opened.recording,
            snapshot.frame,
            snapshot.pair,
            parameters,
            compared.drawn(parameters) if compared else {},
        )
    bar = snapshot.scale_bar
    return {
        "parts": parts,
        "text": bar.text if bar else "",
        "share": round(bar.pixels, 4) if bar else 0,
        "dark": snapshot.settings.dark,
    }
