"""Declaration of metrics: title, unit, format, kind and definition beside each field."""

import math
import re
from dataclasses import dataclass, field
from typing import Any, Literal

MetricKind = Literal["count", "share", "error", "signed"]
"""A whole number; a fraction from 0 to 1; a number not below 0; a number of either sign."""

MetricBest = Literal["least", "most", "nearest to 0"]
"""The best of several values."""

_BEST: dict[MetricKind, MetricBest] = {
    "count": "most",
    "share": "most",
    "error": "least",
    "signed": "nearest to 0",
}


@dataclass(frozen=True)
class MetricInfo:
    """Description of a metric, from which tables, files, plots and the page are made.

    Attributes:
        title: its name.
        unit: "" for a plain number.
        form: format of its values.
        kind: range of its values.
        definition: in words; e and r are those of `ERROR_SYMBOLS`.
        source: publication that defines it.
        plotted: whether the page plots it for every pair.
        best: which of two values is the better one; "nearest to 0" for one of either sign.
    """

    title: str
    unit: str
    form: str
    kind: MetricKind
    definition: str
    source: str
    plotted: bool
    best: MetricBest

    @property
    def heading(self) -> str:
        """Its title with its unit."""
        return f"{self.title} {self.unit}".strip()

    @property
    def described(self) -> str:
        """Its title and definition, as a sentence without the full stop."""
        return f"{self.title[:1].upper()}{self.title[1:]}: {self.definition}"

    @property
    def spec(self) -> str:
        """Format specification of its values, with a sign where it is signed."""
        return f"+{self.form}" if self.kind == "signed" else self.form

    def rank(self, value: float) -> float:
        """Number that is the smaller, the better a value is."""
        return {"least": value, "most": -value, "nearest to 0": abs(value)}[self.best]

    def text(self, value: float | None) -> str:
        """Format a value, – where it is undefined."""
        return "–" if value is None or math.isnan(value) else format(value, self.spec)


def metric(
    title: str,
    definition: str,
    source: str = "",
    *,
    kind: MetricKind = "share",
    unit: str = "",
    form: str = "",
    plotted: bool = False,
    best: MetricBest | None = None,
) -> Any:  # noqa: ANN401 (a dataclass field)
    """Declare a field of `Metrics`; arguments as in `MetricInfo`.

    By default `form` has no decimals for a count, else three, and the best value is the most of
    counts and shares, the least of errors, and the nearest to 0 of what may have either sign.

    Raises:
        ValueError: the format is no number of decimals.
    """
    form = form or (".0f" if kind == "count" else ".3f")
    if not re.fullmatch(r"\.\d+f", form):
        raise ValueError(f"{title}: a format is written .3f, and not {form!r}.")
    best = best or _BEST[kind]
    info = MetricInfo(title, unit, form, kind, definition, source, plotted, best)
    return field(metadata={"metric": info})
