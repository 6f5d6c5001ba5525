"""The table of clusters, with every round, saved as a file."""

from dataclasses import dataclass

import viser

from app.errors import InputError
from app.exports.cluster_csv import cluster_csv
from app.exports.file_names import safe
from app.panels.panel import PanelContext
from app.panels.triggers import post_on
from app.session.command import LatestWins
from app.session.outbox import Download
from app.session.workbench import Workbench


@dataclass(frozen=True)
class SaveClusters(LatestWins):
    """Save the clusters of the frame as CSV."""

    def apply(self, workbench: Workbench) -> None:
        """Send the file.

        Raises:
            InputError: the frame has no estimate.
        """
        opened, pair = workbench.opened, workbench.pair
        if opened is None:
            return
        if pair is None or pair.flow is None:
            raise InputError("There is no estimate of this frame, so there are no clusters.")
        content = cluster_csv(opened.recording, pair, workbench.tuning.parameters)
        name = f"{safe(opened.recording.name)}_frame_{pair.frame:04d}_clusters.csv"
        workbench.outbox.append(Download(name, content.encode()))


def add_save_button(context: PanelContext) -> None:
    """Add a button, and a command of the palette."""
    gui = context.client.gui
    button = gui.add_button(
        "Save clusters as CSV",
        icon=viser.Icon.DOWNLOAD,
        color="gray",
        hint="All clusters of this frame with every round of ICP: points, fitness, displacement, "
        "inliers, label, reason.",
    )
    entry = gui.add_command("Save clusters as CSV", icon=viser.Icon.DOWNLOAD)
    post_on(context.post, SaveClusters(), button, entry)
