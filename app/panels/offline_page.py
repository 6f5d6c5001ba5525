"""Export of the whole recording as one HTML file, in the background."""

from collections.abc import Sequence
from dataclasses import dataclass

import viser

from app.analysis.estimates import Estimates
from app.analysis.library import Library, Opened
from app.errors import InputError
from app.exports.file_names import safe
from app.exports.offline_page import offline_page
from app.panels.panel import Panel, PanelContext
from app.panels.triggers import post_on
from app.scene.views import SLANTED
from app.session.command import LatestWins
from app.session.links import SavedSession
from app.session.outbox import Download, Message, Notice
from app.session.tasks import Report
from app.session.workbench import Workbench

_TITLE = "Offline page"
_QUIET = 0.02  # seconds without foreground work before the next frame
_PATIENCE = 0.5  # seconds after which it continues in any case


@dataclass(frozen=True)
class SaveOfflinePage(LatestWins):
    """Save the recording as an offline page."""

    def apply(self, workbench: Workbench) -> None:
        """Start the export with the current view, settings and parameters.

        The export keeps the recording open, even if the session opens another.

        Raises:
            InputError: another export is running.
            RecordingError: the recording cannot be opened.
        """
        saved, library, estimates = workbench.saved(), workbench.library, workbench.estimates
        if workbench.opened is None or saved is None:
            return
        if workbench.tasks.running(_TITLE):
            raise InputError("An offline page is being made already; wait until it is there.")
        opened = library.open(workbench.opened.entry)
        workbench.tasks.start(
            _TITLE,
            "Drawing frame by frame.",
            lambda report: _make(library, opened, saved, estimates, report),
        )


class OfflinePagePanel(Panel):
    """Button that exports an offline page."""

    def __init__(self, context: PanelContext) -> None:
        button = context.client.gui.add_button(
            "Save offline page",
            icon=viser.Icon.MOVIE,
            color="gray",
            hint="All frames as one HTML file, which plays in any browser without network",
        )
        entry = context.client.gui.add_command("Save offline page", icon=viser.Icon.MOVIE)
        post_on(context.post, SaveOfflinePage(), button, entry)


def _make(
    library: Library, opened: Opened, saved: SavedSession, estimates: Estimates, report: Report
) -> Sequence[Message]:
    frames = range(len(opened.recording))

    def progress(index: int) -> None:
        estimates.foreground.wait_until_quiet(_QUIET, _PATIENCE)
        report(f"Frame {index} of {len(frames) - 1}.")

    try:
        page = offline_page(
            opened,
            frames,
            saved.parameters,
            saved.settings,
            saved.camera or SLANTED,
            estimates,
            progress,
            saved.comparison,
        )
    finally:
        library.release(opened.entry)
    name, content = f"{safe(opened.recording.name)}.html", page.encode()
    sentence = f"{name}, {len(content) / 1e6:.1f} MB, is in your downloads."
    return Download(name, content), Notice(_TITLE, sentence, "green", seconds=10.0)
