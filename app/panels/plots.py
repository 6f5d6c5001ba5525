"""Numbers over the whole recording, filled in the background."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import viser
from numpy.typing import NDArray

from app.analysis.library import Opened
from app.analysis.survey import Survey
from app.browser.plot_clicks import cursor, seek_by_clicks
from app.exports.file_names import safe
from app.exports.survey_csv import to_csv
from app.panels.panel import Desk, Panel, Shown
from app.panels.plot_list import PLOTS, PlotSpec, summary
from app.panels.time_field import TimeField
from app.session.commands import LatestWins
from estimator import Parameters

if TYPE_CHECKING:
    from app.session.workbench import Workbench

_WIDTH = 300  # pixels
_NARROW = 900  # pixels of the scene, of which the plots would take too much


@dataclass(frozen=True)
class ShowSurvey(LatestWins):
    """Show what the background has found out by now."""

    panel: "PlotsPanel"
    asked: tuple[Opened, Parameters]
    survey: Survey

    def fulfil(self, workbench: "Workbench") -> None:
        """Plot it."""
        self.panel.plot(self.asked, self.survey)


@dataclass(frozen=True)
class SavePlots(LatestWins):
    """Save the numbers of the plots as a CSV file."""

    panel: "PlotsPanel"

    def fulfil(self, workbench: "Workbench") -> None:
        """Send the file to the browser."""
        if workbench.opened is not None and (survey := self.panel.survey):
            recording = workbench.opened.recording
            name = f"{safe(recording.name)}_plots.csv"
            workbench.client.send_file_download(
                name, to_csv(recording, survey).encode(), save_immediately=True
            )


class PlotsPanel(Panel):
    """Plots every frame's numbers, says their means, and goes where a person clicks.

    Attributes:
        survey: that is shown, None before the first numbers are there.
    """

    def __init__(self, desk: Desk) -> None:
        self._desk, gui = desk, desk.client.gui
        self.survey: Survey | None = None
        self._asked: tuple[Opened, Parameters] | None = None
        self._colours = desk.settings.palette
        panel = gui.add_panel()
        panel.dock_left()
        panel.set_width(_WIDTH)
        if desk.client.camera.image_width <= _NARROW:
            panel.minimize()
        with panel.add_tab("Plots", viser.Icon.CHART_DOTS):
            self._summary = gui.add_html("")
            self._cursor = gui.add_html("")
            self._headings: list[viser.GuiHtmlHandle] = []
            self._plots: list[viser.GuiUplotHandle] = []
            for plot in PLOTS:
                self._headings.append(gui.add_html(""))
                self._plots.append(plot.add_to(gui, self._colours))
            self._time = TimeField(desk)
            save = gui.add_button("Save as CSV", icon=viser.Icon.DOWNLOAD, color="gray")

        command = gui.add_command("Save plots as CSV", icon=viser.Icon.DOWNLOAD)

        # Coroutines run at once, before anything can change a control's value again.
        @save.on_click
        async def _(_: viser.GuiEvent) -> None:
            desk.post(SavePlots(self))

        @command.on_trigger
        async def _(_: viser.CommandEvent) -> None:
            desk.post(SavePlots(self))

    def open(self, opened: Opened) -> None:
        """Prepare for a recording's time and truth."""
        recording = opened.recording
        end = _seconds(recording.stamps)
        self._time.open(opened)
        seek_by_clicks(self._desk.client, self._time.field, 0.0, end)
        shown = [plot for plot in PLOTS if recording.has_truth or not plot.needs_truth]
        with self._desk.client.atomic():
            for plot, heading, handle in self._each():
                heading.visible = handle.visible = plot in shown
                plot.label_times(handle, labelled=plot is shown[-1])
                handle.data = (np.array([0.0, end]), *[np.full(2, np.nan)] * len(plot.lines))
                handle.scales = plot.scales(end, None)

    def close(self) -> None:
        """Ask for nothing of this recording any more."""
        self._desk.surveys.leave(self)
        self._asked = self.survey = None

    def show(self, shown: Shown) -> None:
        """Ask for what is shown, and draw the line at its frame."""
        asked = (shown.opened, shown.parameters)
        if asked != self._asked:
            self._asked, self.survey = asked, None
            self._summary.content = summary(None, has_truth=shown.opened.recording.has_truth)
            post = self._desk.post
            self._desk.surveys.ask(
                self, *asked, lambda survey: post(ShowSurvey(self, asked, survey))
            )
        stamps = shown.opened.recording.stamps
        share = (stamps[shown.frame] - stamps[0]) / _seconds(stamps)
        self._cursor.content = cursor(float(share), pale=self.survey is None)
        self._time.show(shown)
        colours, before = shown.settings.palette, self._colours
        self._colours = colours
        for plot, heading, handle in self._each():
            heading.content = plot.heading(
                self.survey, shown.frame, colours, has_truth=shown.opened.recording.has_truth
            )
            if colours is not before:
                handle.series = plot.series(colours)

    def plot(self, asked: tuple[Opened, Parameters], survey: Survey) -> None:
        """Show what is known by now, unless something else was asked for meanwhile."""
        if asked is not self._asked:
            return
        # Other scales make the page build a plot anew, and so do the same ones once more. A plot
        # that is given data while it is still being built loses its horizontal axis: the last data
        # come with building it, and so do the first, which may follow `open` at once.
        anew = self.survey is None or survey.complete
        self.survey = survey
        recording = asked[0].recording
        self._summary.content = summary(survey, has_truth=recording.has_truth)
        times = recording.stamps - recording.stamps[0]
        with self._desk.client.atomic():
            for plot, _, handle in self._each():
                handle.data = (times, *plot.data(survey))
                scales = plot.scales(_seconds(recording.stamps), survey)
                if anew or handle.scales != scales:
                    handle.scales = scales

    def _each(self) -> Iterator[tuple[PlotSpec, viser.GuiHtmlHandle, viser.GuiUplotHandle]]:
        return zip(PLOTS, self._headings, self._plots, strict=True)


def _seconds(stamps: NDArray[np.float64]) -> float:
    """How long a recording is, above 0 also where it has one frame only."""
    return max(float(stamps[-1] - stamps[0]), 1e-3)
