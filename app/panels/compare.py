"""Comparison of two sets of parameters, or two methods: A and B."""

from dataclasses import dataclass, replace

import viser

from app.analysis.comparison import A, B, Comparison, by_side
from app.browser.controls import show_value
from app.errors import InputError
from app.panels.differences import Totals, changes, difference_table, other_pairs, totals, verdict
from app.panels.panel import Panel, PanelContext
from app.panels.plot_words import progress
from app.panels.tables import framed
from app.panels.triggers import post_on
from app.scene.colours import css
from app.session.command import LatestWins, Repeated
from app.session.snapshot import Snapshot
from app.session.workbench import Workbench


@dataclass(frozen=True)
class CopyToB(LatestWins):
    """Make B a copy of A, and edit it."""

    def apply(self, workbench: Workbench) -> None:
        """Replace B by A, and edit B."""
        tuning = workbench.tuning
        before, parameters = tuning.comparison, tuning.parameters
        if before is None:
            tuning.compare(Comparison(parameters, B), parameters)
        else:
            of_a, _ = before.in_order(parameters, before.other)
            tuning.compare(replace(before, other=of_a, edited=B), of_a)


@dataclass(frozen=True)
class SwitchSide(Repeated):
    """Switch the edited side, as often as posted; creates B if it is missing."""

    def apply(self, workbench: Workbench) -> None:
        """Edit the other side."""
        tuning = workbench.tuning
        before = tuning.comparison
        if before is None:
            CopyToB().apply(workbench)
        elif self.times % 2:
            tuning.compare(before.switched(tuning.parameters), before.other)


@dataclass(frozen=True)
class DrawBoth(LatestWins):
    """Draw the flow of both sides, or of the edited one alone."""

    both: bool

    def apply(self, workbench: Workbench) -> None:
        """Set it, if there is a B."""
        if (before := workbench.tuning.comparison) is not None:
            workbench.tuning.comparison = replace(before, both=self.both)


@dataclass(frozen=True)
class ToggleBoth(Repeated):
    """Toggle between drawing the flow of both sides and of one, this many times."""

    def apply(self, workbench: Workbench) -> None:
        """Toggle it; InputError without B."""
        before = workbench.tuning.comparison
        if before is None:
            raise InputError("There is no B to draw; copy A to B first.")
        workbench.tuning.comparison = replace(before, both=before.both ^ bool(self.times % 2))


@dataclass(frozen=True)
class RemoveB(LatestWins):
    """Remove B, and edit A."""

    def apply(self, workbench: Workbench) -> None:
        """End the comparison."""
        tuning = workbench.tuning
        if (before := tuning.comparison) is not None:
            of_a, _ = before.in_order(tuning.parameters, before.other)
            tuning.compare(None, of_a)


class ComparePanel(Panel):
    """Controls of the comparison, and a table of the current pair and the whole recording."""

    def __init__(self, context: PanelContext) -> None:
        gui, post = context.client.gui, context.post
        self._last: Comparison | None = None
        self._counted: tuple[object, ...] = ()
        self._totals: dict[str, Totals | None] = {}
        self._state = gui.add_html("")
        copy = gui.add_button(
            "Copy A to B",
            icon=viser.Icon.COPY,
            color="gray",
            hint="B begins as A is now; change it with the controls of the parameters.",
        )
        self._switch = gui.add_button(
            "Switch to B", icon=viser.Icon.SWITCH_HORIZONTAL, visible=False, hint="Key B"
        )
        self._both = gui.add_checkbox(
            "Draw both", False, visible=False, hint="The flow of A and of B in the scene."
        )
        self._table = gui.add_html("")
        self._remove = gui.add_button("Remove B", icon=viser.Icon.X, color="gray", visible=False)
        switching = gui.add_command(
            "Compare: switch between A and B", hotkey="B", icon=viser.Icon.SWITCH_HORIZONTAL
        )
        drawing = gui.add_command("Compare: draw both", icon=viser.Icon.LAYERS_INTERSECT)
        copying = gui.add_command("Compare: copy A to B", icon=viser.Icon.COPY)
        removing = gui.add_command("Compare: remove B", icon=viser.Icon.X)

        post_on(post, CopyToB(), copy, copying)
        post_on(post, SwitchSide(), self._switch, switching)
        post_on(post, ToggleBoth(), drawing)
        post_on(post, RemoveB(), self._remove, removing)

        # A coroutine runs at once, before the control's value can change again.
        @self._both.on_update
        async def _(event: viser.GuiEvent) -> None:
            if event.client_id is not None:
                post(DrawBoth(self._both.value))

    def show(self, snapshot: Snapshot) -> None:
        """Show which side is edited, and how A and B differ."""
        comparison, before = snapshot.comparison, self._last
        self._last = comparison
        self._switch.visible = self._both.visible = self._remove.visible = comparison is not None
        if comparison is None:
            self._state.content = framed(
                "B is a second set of parameters, or another method. Copy A to B, then change it."
            )
            self._table.content = ""
            return
        edited, other = comparison.edited, A if comparison.edited == B else B
        if before is None or before.both != comparison.both:
            # Not set without a change: the user may just have switched it.
            show_value(self._both, comparison.both)
        self._switch.label = f"Switch to {other}"
        colour = css(snapshot.settings.palette.second)
        mark = f' <span style="color: {colour}">■</span>&nbsp;The flow of B, over that of A.'
        legend = mark if comparison.both else ""
        self._state.content = framed(
            f"<b>{edited}</b> is shown, and what the parameters' controls change.{legend}"
        )
        of_a, of_b = comparison.in_order(snapshot.parameters, comparison.other)
        self._table.content = framed(changes(of_a, of_b) + self._numbers(snapshot, comparison))

    def _numbers(self, snapshot: Snapshot, comparison: Comparison) -> str:
        surveys = by_side(comparison, snapshot.survey, snapshot.other_survey)
        state = (*surveys.values(), snapshot.survey_revision, snapshot.other_survey_revision)
        if state != self._counted:
            self._counted = state
            self._totals = {side: totals(s) if s else None for side, s in surveys.items()}
        pairs = by_side(comparison, snapshot.pair, snapshot.other)
        has_truth = snapshot.opened.recording.has_truth
        counts = {
            side: ("yes" if s.counts[snapshot.frame] else "no") if s and has_truth else "–"
            for side, s in surveys.items()
        }
        share, frames = progress(surveys)
        missing = next((side for side, pair in pairs.items() if pair is None), None)
        sentences = [
            "Bold: the better one. Errors are means over the pairs that count."
            if has_truth
            else "No truth in this recording: no error says which is better.",
            f"Whole recording so far: {frames or 'nothing yet'}." if share < 1 else "",
            f"{missing} is not estimated here; switch to it or draw both."
            if missing and snapshot.pair
            else "",
        ]
        said = "".join(f"<div>{sentence}</div>" for sentence in sentences if sentence)
        decided = f"<div>{verdict(self._totals)}{other_pairs(self._totals)}</div>"
        decided = decided if has_truth else ""
        return decided + difference_table(pairs, self._totals, counts) + said
