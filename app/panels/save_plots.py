"""Plots saved as a table or as a picture."""

from collections.abc import Sequence
from dataclasses import dataclass

import viser

from app.analysis.comparison import by_side
from app.errors import InputError
from app.exports.file_names import safe
from app.exports.survey_csv import to_csv
from app.exports.survey_figure import FORMS, survey_figure
from app.panels.panel import PanelContext
from app.panels.plot_list import plots
from app.panels.triggers import post_chosen, post_on
from app.session.command import LatestWins
from app.session.making import Making, delivered, start_making
from app.session.outbox import Download, Message
from app.session.workbench import Workbench

_CSV = "csv"
_TITLE = "Picture of the plots"
_CHOICES = {form.upper(): form for form in (_CSV, *FORMS)}


@dataclass(frozen=True)
class SavePlots(LatestWins):
    """Save the numbers of the plots as CSV, or their picture as PNG, SVG or PDF."""

    form: str

    def apply(self, workbench: Workbench) -> None:
        """Export the surveys that there are.

        Raises:
            InputError: nothing is computed yet, or a picture is being made already.
        """
        opened, followed = workbench.opened, workbench.surveys
        of_sides = by_side(
            workbench.tuning.comparison, followed.edited.survey, followed.other.survey
        )
        surveys = {side: survey for side, survey in of_sides.items() if survey is not None}
        if opened is None:
            return
        if not surveys:
            raise InputError("Nothing of the whole recording is computed yet; try again at once.")
        name = f"{safe(opened.recording.name)}_plots.{self.form}"
        if self.form == _CSV:
            content = to_csv(opened.recording, surveys).encode()
            workbench.outbox.append(Download(name, content))
            return
        pair, colours = workbench.plotted_pair, workbench.settings.colours

        def draw(making: Making) -> Sequence[Message]:
            recording = making.opened.recording
            names = [q.name for q in plots(has_truth=recording.has_truth)]
            picture = survey_figure(
                recording, surveys, names, self.form, pair=pair, colours=colours
            )
            return delivered(_TITLE, name, picture)

        start_making(workbench, _TITLE, f"Drawing {name}.", draw)


def add_save_buttons(context: PanelContext) -> None:
    """Add a button for each kind of file, and commands of the palette."""
    gui = context.client.gui
    buttons = gui.add_button_group(
        "Save as",
        tuple(_CHOICES),
        hint="CSV: all numbers of every frame. PNG, SVG, PDF: the plots as a figure for print.",
    )

    # A coroutine runs at once, before the control's value can change again.
    @buttons.on_click
    async def _(_: viser.GuiEvent) -> None:
        post_chosen(context.post, buttons, _CHOICES, SavePlots)

    for written, form in _CHOICES.items():
        entry = gui.add_command(f"Save plots as {written}", icon=viser.Icon.DOWNLOAD)
        post_on(context.post, SavePlots(form), entry)
