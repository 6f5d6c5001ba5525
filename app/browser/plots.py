"""Plots of ours in the page, which keep the numbers of a recording and answer while hovering.

They are drawn by `assets/plots.js`. viser's plots cannot show values, zoom together or have hollow
points, and rebuild themselves whenever anything but their data changes.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass

import numpy as np
import viser
from numpy.typing import NDArray

from app.browser.assets import call, packed, run_asset
from app.browser.page_events import EventContent, PageEvents

PLACE = '<div data-tofscope-plots=""></div>'
"""HTML of the element that the plots are put into."""

_SCRIPTS = ("plot_data.js", "plot_drawing.js", "plot_pointer.js", "plot_pair.js", "plots.js")
_FRAMES = 10_000  # at most in one message, so that others pass in between


@dataclass(frozen=True)
class PlottedQuantity:
    """A quantity as the page writes and draws it.

    Attributes:
        name: of its numbers.
        title: without the unit.
        unit: "" for none.
        digits: after the decimal point.
        signed: whether values may be negative; 0 is then in the middle of the axis.
        top: end of the axis, None to follow the data.
        reference: name of the numbers that are drawn with it, as true; None without any.
    """

    name: str
    title: str
    unit: str
    digits: int
    signed: bool = False
    top: float | None = None
    reference: str | None = None


class _Sought(EventContent):
    frame: int


class LinkedPlots:
    """Plots over a recording's time with one cursor, and one of two quantities.

    Args:
        client: owner of the page.
        events: of the page.
        seek: called with the frame of a click, in viser's event loop; may be beyond the recording.
    """

    def __init__(
        self, client: viser.ClientHandle, events: PageEvents, seek: Callable[[int], None]
    ) -> None:
        self._client = client
        for name in ("plots.css", *_SCRIPTS):
            run_asset(client, name)
        events.on("plots.seek", _Sought, lambda content: seek(content.frame))

    def open(self, times: NDArray[np.float64], quantities: Sequence[PlottedQuantity]) -> None:
        """Begin with the frames' times (K,) s and these plots, from top to bottom."""
        call(self._client, "plots.open", packed(times, "<f8"), [asdict(q) for q in quantities])

    def look(self, sides: Sequence[str], colours: Mapping[str, str]) -> None:
        """Show these sides in these colours: {side, or "truth" for references: CSS colour}."""
        call(self._client, "plots.look", list(sides), dict(colours))

    def outdate(self, side: str) -> None:
        """Draw a side's numbers pale until other ones come."""
        call(self._client, "plots.outdate", side)

    def add(
        self,
        side: str,
        frames: NDArray[np.int64],
        counts: NDArray[np.bool_],
        numbers: Mapping[str, NDArray[np.float64]],
    ) -> None:
        """Add a side's numbers of some frames.

        Args:
            side: that they are of.
            frames: (F,).
            counts: (F,) whether a frame's pair counts; the points of others are hollow.
            numbers: {name: (F,)}, NaN where undefined.
        """
        for start in range(0, len(frames), _FRAMES):
            part = slice(start, start + _FRAMES)
            arrays = {name: packed(values[part], "<f4") for name, values in numbers.items()}
            coded = packed(frames[part], "<u4"), packed(counts[part], "u1")
            call(self._client, "plots.add", side, *coded, arrays)

    def say(self, notes: Mapping[str, str], sentence: str) -> None:
        """Write {name of a quantity: text} at its plots, and a sentence above enlarged ones."""
        call(self._client, "plots.say", dict(notes), sentence)

    def at(self, frame: int) -> None:
        """Draw the line of the current frame there."""
        call(self._client, "plots.at", frame)

    def against(self, x: PlottedQuantity, y: PlottedQuantity) -> None:
        """Plot y against x, point by point."""
        call(self._client, "plots.pair", {"x": asdict(x), "y": asdict(y)})

    def against_nothing(self) -> None:
        """Remove the plot of two quantities."""
        call(self._client, "plots.pair", None)


def enlarge_plots(client: viser.ClientHandle) -> None:
    """Lay the plots over the window, or put them back."""
    call(client, "plots.enlarge")
