"""Choice of two quantities that are plotted against each other."""

import reprlib
from dataclasses import dataclass

import viser

from app.analysis.quantities import QUANTITIES
from app.browser.controls import show_value
from app.panels.panel import PanelContext
from app.session.command import Command, LatestWins
from app.session.commands import Refuse
from app.session.snapshot import Snapshot
from app.session.workbench import Workbench

_NOTHING = "nothing"
_FIRST = "time"  # of x, before any is chosen
_ALL = {quantity.label: name for name, quantity in QUANTITIES.items()}


@dataclass(frozen=True)
class PlotPair(LatestWins):
    """Plot a quantity y against a quantity x, or none."""

    pair: tuple[str, str] | None

    def apply(self, workbench: Workbench) -> None:
        """Show that plot."""
        workbench.plotted_pair = self.pair


class PairChoice:
    """Two lists of all quantities; part of a panel."""

    def __init__(self, context: PanelContext) -> None:
        gui, self._post = context.client.gui, context.post
        self._y: viser.GuiDropdownHandle[str] = gui.add_dropdown(
            "Plot",
            (_NOTHING, *_ALL),
            hint="This quantity is plotted against the next, a point for every frame; a click on "
            "a point goes there.",
        )
        self._x: viser.GuiDropdownHandle[str] = gui.add_dropdown("against", tuple(_ALL))

        # Coroutines run at once, before a control's value can change again.
        @self._y.on_update
        async def _(event: viser.GuiEvent) -> None:
            self._chosen(event)

        @self._x.on_update
        async def _(event: viser.GuiEvent) -> None:
            self._chosen(event)

    def show(self, snapshot: Snapshot) -> None:
        """Show what is plotted."""
        if snapshot.plotted_pair is None:
            show_value(self._y, _NOTHING)
            return
        x, y = (QUANTITIES[name].label for name in snapshot.plotted_pair)
        show_value(self._x, x)
        show_value(self._y, y)

    def _chosen(self, event: viser.GuiEvent) -> None:
        if event.client_id is not None:
            self._post(_command(str(self._x.value), str(self._y.value)))


def _command(x: str, y: str) -> Command:
    """Command for two options; a browser may send others, too."""
    for label in (x, y):
        if label not in _ALL and label != _NOTHING:
            return Refuse(f"There is nothing called {reprlib.repr(label)} to plot.")
    return PlotPair(None if y == _NOTHING else (_ALL.get(x, _FIRST), _ALL[y]))
