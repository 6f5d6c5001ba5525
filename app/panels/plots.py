"""Plots over the whole recording, filled in the background."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import viser
from numpy.typing import NDArray

from app.analysis.library import Opened
from app.analysis.survey import Survey
from app.browser.plot_clicks import cursor, seek_by_clicks
from app.browser.script import window_width
from app.exports.file_names import safe
from app.exports.survey_csv import to_csv
from app.panels.panel import Panel, PanelContext
from app.panels.plot_list import PLOTS, PlotSpec, summary
from app.panels.time_field import TimeField
from app.panels.triggers import post_on
from app.session.command import LatestWins
from app.session.outbox import Download
from app.session.snapshot import Snapshot
from app.session.workbench import Workbench
from recordings import Recording

_WIDTH = 300  # pixels
_NARROW = 1260  # pixels; on pages up to this width the plots start folded


@dataclass(frozen=True)
class SavePlots(LatestWins):
    """Save the numbers of the plots as a CSV file."""

    def apply(self, workbench: Workbench) -> None:
        """Export the survey, if there is one."""
        survey = workbench.survey.survey
        if workbench.opened is not None and survey is not None:
            recording = workbench.opened.recording
            name = f"{safe(recording.name)}_plots.csv"
            workbench.outbox.append(Download(name, to_csv(recording, survey).encode()))


class PlotsPanel(Panel):
    """Plots of all frames with their means; clicks seek."""

    def __init__(self, context: PanelContext) -> None:
        self._client, gui = context.client, context.client.gui
        self._plotted: Survey | None = None
        self._revision = 0
        self._colours = context.settings.palette
        panel = gui.add_panel()
        panel.dock_left()
        panel.set_width(_WIDTH)
        if window_width(context.client) <= _NARROW:
            panel.minimize()
        with panel.add_tab("Plots", viser.Icon.CHART_DOTS):
            self._summary = gui.add_html("")
            self._cursor = gui.add_html("")
            self._headings: list[viser.GuiHtmlHandle] = []
            self._plots: list[viser.GuiUplotHandle] = []
            for plot in PLOTS:
                self._headings.append(gui.add_html(""))
                self._plots.append(plot.add_to(gui, self._colours))
            self._time = TimeField(context)
            save = gui.add_button("Save as CSV", icon=viser.Icon.DOWNLOAD, color="gray")

        entry = gui.add_command("Save plots as CSV", icon=viser.Icon.DOWNLOAD)
        post_on(context.post, SavePlots(), save, entry)

    def open(self, opened: Opened) -> None:
        """Set axes, and select plots by whether there is truth."""
        recording = opened.recording
        end = _seconds(recording.stamps)
        self._time.open(opened)
        seek_by_clicks(self._client, self._time.field, 0.0, end)
        shown = [plot for plot in PLOTS if recording.has_truth or not plot.needs_truth]
        with self._client.atomic():
            for plot, heading, handle in self._each():
                heading.visible = handle.visible = plot in shown
                plot.label_times(handle, labelled=plot is shown[-1])
                handle.data = (np.array([0.0, end]), *[np.full(2, np.nan)] * len(plot.lines))
                handle.scales = plot.scales(end, None)

    def show(self, snapshot: Snapshot) -> None:
        """Update the plots, and the line at the current frame."""
        recording, survey = snapshot.opened.recording, snapshot.survey
        if survey is None:
            self._summary.content = summary(None, has_truth=recording.has_truth)
        elif snapshot.survey_revision != self._revision:
            self._plot(recording, survey)
        self._plotted, self._revision = survey, snapshot.survey_revision
        stamps = recording.stamps
        share = (stamps[snapshot.frame] - stamps[0]) / _seconds(stamps)
        self._cursor.content = cursor(float(share), pale=survey is None)
        self._time.show(snapshot)
        colours, before = snapshot.settings.palette, self._colours
        self._colours = colours
        for plot, heading, handle in self._each():
            heading.content = plot.heading(
                survey, snapshot.frame, colours, has_truth=recording.has_truth
            )
            if colours is not before:
                handle.series = plot.series(colours)

    def _plot(self, recording: Recording, survey: Survey) -> None:
        # Assigning scales, even equal ones, makes the page rebuild a plot, and data that arrive
        # during a rebuild make it lose its horizontal axis. The first data, which may follow `open`
        # at once, and the last data are therefore sent together with scales.
        with_scales = self._plotted is not survey or survey.complete
        self._summary.content = summary(survey, has_truth=recording.has_truth)
        times = recording.stamps - recording.stamps[0]
        with self._client.atomic():
            for plot, _, handle in self._each():
                handle.data = (times, *plot.data(survey))
                scales = plot.scales(_seconds(recording.stamps), survey)
                if with_scales or handle.scales != scales:
                    handle.scales = scales

    def _each(self) -> Iterator[tuple[PlotSpec, viser.GuiHtmlHandle, viser.GuiUplotHandle]]:
        return zip(PLOTS, self._headings, self._plots, strict=True)


def _seconds(stamps: NDArray[np.float64]) -> float:
    """Duration of a recording, above 0 even for a single frame."""
    return max(float(stamps[-1] - stamps[0]), 1e-3)
