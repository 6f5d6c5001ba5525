"""Quantities of every frame that plots, tables and files show, with their units and formats."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.analysis.survey import Survey
from estimator import METRIC_INFO
from recordings import Recording


@dataclass(frozen=True)
class Quantity:
    """A number of every frame.

    Attributes:
        title: its name, in lower case as far as words go.
        unit: "" for a plain number.
        spec: format of its values.
        values: (K,) of a recording and its survey, NaN where not known or undefined.
        kind: range of its values, as of a metric.
        needs_truth: whether it is unknown without truth.
    """

    title: str
    unit: str
    spec: str
    values: Callable[[Recording, Survey], NDArray[Any]]
    kind: str = "error"
    needs_truth: bool = False

    @property
    def name(self) -> str:
        """Its title, capitalised."""
        return self.title[:1].upper() + self.title[1:]

    @property
    def label(self) -> str:
        """Its title, capitalised, with its unit, such as "Angle deviation [°]"."""
        return f"{self.name} [{self.unit}]" if self.unit else self.name


def page_unit(unit: str) -> str:
    """Unit as people write it."""
    return "°" if unit == "deg" else unit


def _recorded(
    title: str, unit: str, spec: str, name: str, *, needs_truth: bool = False
) -> Quantity:
    kind = "count" if spec == ".0f" else "error"
    return Quantity(title, unit, spec, lambda _, s: getattr(s, name), kind, needs_truth)


def _metric(name: str) -> Quantity:
    info = METRIC_INFO[name]
    return Quantity(
        title=info.title,
        unit=page_unit(info.unit),
        spec=info.spec,
        values=lambda _, survey: survey.metrics[name],
        kind=info.kind,
        needs_truth=True,
    )


QUANTITIES: dict[str, Quantity] = {
    "time": Quantity("time", "s", ".3f", lambda recording, _: times(recording)),
    "points": _recorded("source points", "", ".0f", "points"),
    "moving": _recorded("moving points", "", ".0f", "moving"),
    "stationary": _recorded("stationary points", "", ".0f", "stationary"),
    "unassigned": _recorded("unassigned points", "", ".0f", "unassigned"),
    "clusters": _recorded("clusters", "", ".0f", "clusters"),
    "interval": _recorded("Δt of the pair", "s", ".3f", "interval"),
    "valid": _recorded("valid zones", "", ".2f", "valid"),
    "speed": _recorded("estimated speed", "m/s", ".3f", "speed"),
    "true_speed": _recorded("true speed", "m/s", ".3f", "true_speed", needs_truth=True),
    **{
        name: _metric(name)
        for name, info in METRIC_INFO.items()
        if info.plotted or info.kind != "count"
    },
}
"""{name: quantity}, all that a survey holds, time first."""


def times(recording: Recording) -> NDArray[np.float64]:
    """Seconds (K,) from the first frame."""
    return recording.stamps - recording.stamps[0]
