"""Export of the range that is played as one HTML file, in the background."""

from collections.abc import Sequence
from dataclasses import dataclass

import viser

from app.exports.drawn_pair import DrawnPairs
from app.exports.file_names import safe
from app.exports.offline_page import offline_page
from app.panels.panel import Panel, PanelContext
from app.panels.triggers import post_on
from app.scene.views import SLANTED
from app.session.command import LatestWins
from app.session.making import Making, delivered, start_making
from app.session.outbox import Message
from app.session.workbench import Workbench

_TITLE = "Offline page"


@dataclass(frozen=True)
class SaveOfflinePage(LatestWins):
    """Save the range that is played as an offline page, which begins at the current frame."""

    def apply(self, workbench: Workbench) -> None:
        """Start the export with the current view, settings and parameters.

        Raises:
            InputError: another export is running.
            RecordingError: the recording cannot be opened.
        """
        saved, pair = workbench.saved(), workbench.pair
        if saved is None:
            return
        playback = workbench.clock.playback
        frames = range(playback.first, playback.last + 1)
        picked = None if pair is None or saved.picked is None else (pair, saved.picked)
        begin = min(max(saved.frame, playback.first), playback.last)

        def make(making: Making) -> Sequence[Message]:
            opened = making.opened
            pairs = DrawnPairs(opened, saved.parameters, making.estimates, saved.comparison, picked)
            page = offline_page(
                pairs,
                frames,
                begin,
                saved.settings,
                saved.camera or SLANTED,
                lambda index: making.step(f"Frame {index + 1} of {len(frames)}."),
            )
            return delivered(_TITLE, f"{safe(opened.recording.name)}.html", page.encode())

        start_making(workbench, _TITLE, "Drawing frame by frame.", make)


class OfflinePagePanel(Panel):
    """Button that exports an offline page."""

    def __init__(self, context: PanelContext) -> None:
        button = context.client.gui.add_button(
            "Save offline page",
            icon=viser.Icon.MOVIE,
            color="gray",
            hint="Frames of the range that is played, as one HTML file that plays without network",
        )
        entry = context.client.gui.add_command("Save offline page", icon=viser.Icon.MOVIE)
        post_on(context.post, SaveOfflinePage(), button, entry)
