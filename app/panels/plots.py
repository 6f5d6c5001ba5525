"""Plots over the whole recording, filled in the background."""

from dataclasses import dataclass

import viser

from app.analysis.comparison import A, B, by_side
from app.analysis.library import Opened
from app.analysis.quantities import times
from app.analysis.survey import Survey
from app.browser.plots import PLACE, LinkedPlots
from app.output.text import escaped
from app.panels.panel import Panel, PanelContext
from app.panels.plot_feed import PlotFeed
from app.panels.plot_list import PLOTS, plots, plotted
from app.panels.plot_pair import PairChoice
from app.panels.plot_words import means, progress, summary, summary_html
from app.panels.save_plots import add_save_buttons
from app.panels.triggers import post_on
from app.scene.colours import css
from app.scene.palettes import Palette
from app.session.command import LatestWins
from app.session.commands import seek
from app.session.outbox import EnlargePlots
from app.session.snapshot import Snapshot
from app.session.workbench import Workbench

_SENT = (*PLOTS, "true_speed")


@dataclass(frozen=True)
class Enlarge(LatestWins):
    """Lay the plots over the window, or put them back."""

    def apply(self, workbench: Workbench) -> None:
        """Tell the page, which alone knows how they lie."""
        workbench.outbox.append(EnlargePlots())


class PlotsPanel(Panel):
    """Plots of all frames for A and B, with one cursor; clicks seek."""

    def __init__(self, context: PanelContext) -> None:
        gui = context.client.gui
        self._plots = LinkedPlots(
            context.client, context.events, lambda frame: context.post(seek(frame))
        )
        self._feeds: dict[str, PlotFeed] = {}
        self._look: tuple[tuple[str, ...], Palette] | None = None
        self._frame: int | None = None
        self._pair: tuple[str, str] | None = None
        self._notes: tuple[dict[str, str], str] = {}, ""
        self._said: object = None
        self._summary = gui.add_html("")
        gui.add_html(PLACE)
        self._choice = PairChoice(context)
        add_save_buttons(context)
        enlarging = gui.add_command("Enlarge plots", icon=viser.Icon.ARROWS_MAXIMIZE)
        post_on(context.post, Enlarge(), enlarging)

    def open(self, opened: Opened) -> None:
        """Begin with another recording, and select plots by whether there is truth."""
        recording = opened.recording
        names = _SENT if recording.has_truth else PLOTS
        self._feeds = {side: PlotFeed(self._plots, side, names) for side in (A, B)}
        self._frame, self._notes = None, ({}, "")
        self._plots.open(times(recording), plots(has_truth=recording.has_truth))

    def show(self, snapshot: Snapshot) -> None:
        """Send what is new: numbers, colours, the frame, the means."""
        recording = snapshot.opened.recording
        surveys = by_side(snapshot.comparison, snapshot.survey, snapshot.other_survey)
        look = (tuple(surveys), snapshot.settings.palette)
        if look != self._look:
            self._look = look
            self._plots.look(list(surveys), _colours(snapshot.settings.palette))
        self._show_pair(snapshot.plotted_pair)
        for side, survey in surveys.items():
            self._feeds[side].send(recording, survey, snapshot.plotted_pair or ())
        if snapshot.frame != self._frame:
            self._frame = snapshot.frame
            self._plots.at(snapshot.frame)
        self._say(snapshot, surveys)
        self._choice.show(snapshot)

    def _show_pair(self, pair: tuple[str, str] | None) -> None:
        if pair == self._pair:
            return
        self._pair = pair
        if pair is None:
            self._plots.against_nothing()
        else:
            self._plots.against(*map(plotted, pair))

    def _say(self, snapshot: Snapshot, surveys: dict[str, Survey | None]) -> None:
        revisions = snapshot.survey_revision, snapshot.other_survey_revision
        state = (snapshot.opened, revisions, *((side, id(s)) for side, s in surveys.items()))
        if state == self._said:
            return
        self._said = state
        has_truth = snapshot.opened.recording.has_truth
        sentence = summary(surveys, has_truth=has_truth)
        share, _ = progress(surveys)
        self._summary.content = summary_html(sentence, share)
        said = (means(surveys) if has_truth else {}, f"{_name(snapshot.opened)}. {sentence}")
        if said != self._notes:
            self._notes = said
            self._plots.say(*said)


def _colours(palette: Palette) -> dict[str, str]:
    return {A: css(palette.side(A)), B: css(palette.side(B)), "truth": css(palette.truth)}


def _name(opened: Opened) -> str:
    simulated = " (simulated)" if opened.recording.simulated else ""
    return f"{escaped(opened.recording.name)}{simulated}"
