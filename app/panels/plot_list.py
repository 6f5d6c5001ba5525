"""The plots of the page, from top to bottom."""

import re
from dataclasses import replace

from app.analysis.quantities import QUANTITIES
from app.browser.plots import PlottedQuantity
from app.panels.tables import PLOTTED

PLOTS = ("moving", "speed", *PLOTTED)
"""Names of the quantities that are plotted over time."""

_SPEED = {"title": "Speed", "reference": "true_speed"}
"""Differences of the plot of the speed where the true one is drawn with it."""


def plots(*, has_truth: bool) -> list[PlottedQuantity]:
    """All plots over time of a recording."""
    shown = [name for name in PLOTS if has_truth or not QUANTITIES[name].needs_truth]
    return [
        replace(plotted(name), **_SPEED) if name == "speed" and has_truth else plotted(name)
        for name in shown
    ]


def plotted(name: str) -> PlottedQuantity:
    """A quantity as the page plots it."""
    quantity = QUANTITIES[name]
    decimals = re.search(r"\.(\d+)f", quantity.spec)
    return PlottedQuantity(
        name=name,
        title=quantity.name,
        unit=quantity.unit,
        digits=int(decimals[1]) if decimals else 0,
        signed=quantity.kind == "signed",
        top=1.0 if quantity.kind == "share" else None,
    )
