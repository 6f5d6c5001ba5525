"""Differences between two estimates of one frame, in numbers."""

import math
from collections.abc import Callable
from dataclasses import fields
from html import escape

from app.analysis.estimates import Pair
from app.panels.tables import Row, signed, table
from estimator import PARAMETER_INFO, Label, Metrics, Parameters

_NAN = float("nan")


def _labelled(label: Label) -> Callable[[Pair], float]:
    return lambda pair: float((pair.flow.label == label).sum()) if pair.flow else _NAN


def _error(value: Callable[[Metrics], float]) -> Callable[[Pair], float]:
    return lambda pair: value(errors) if (errors := pair.errors) else _NAN


_ROWS: dict[str, tuple[str, Callable[[Pair], float]]] = {
    "Moving": ("{:.0f}", _labelled(Label.MOVING)),
    "Stationary": ("{:.0f}", _labelled(Label.STATIONARY)),
    "Unassigned": ("{:.0f}", _labelled(Label.UNASSIGNED)),
    "Clusters": ("{:.0f}", lambda pair: len(pair.flow.clusters) if pair.flow else _NAN),
    "Angle deviation [°]": ("{:.1f}", _error(lambda errors: errors.angle_deg)),
    "Vel. error [m/s]": ("{:.3f}", _error(lambda errors: errors.velocity_error)),
    "Coverage [%]": ("{:.1f}", _error(lambda errors: 100 * errors.coverage)),
    "Precision [%]": ("{:.1f}", _error(lambda errors: 100 * errors.precision)),
}
"""{what is compared: how it is written, and what it is of a pair}; NaN where nothing defines it."""


def difference_table(of_a: Pair | None, of_b: Pair | None) -> str:
    """Numbers estimated with A, with B, and B less A; a dash where one is not known."""
    rows = [Row((name, *_cells(name, of_a, of_b))) for name in _ROWS]
    return table(("", "A", "B", "B − A"), rows)


def changes(of_a: Parameters, of_b: Parameters) -> str:
    """The parameters in which A and B differ, by name."""
    said = [
        f"{PARAMETER_INFO[field.name].symbol or field.name}: {_written(one)} → {_written(two)}"
        for field in fields(Parameters)
        if (one := getattr(of_a, field.name)) != (two := getattr(of_b, field.name))
    ]
    if not said:
        return "<div>B has the same parameters as A.</div>"
    return f"<div>From A to B: {escape(', '.join(said))}</div>"


def _written(value: object) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


def _cells(name: str, of_a: Pair | None, of_b: Pair | None) -> tuple[str, str, str]:
    form, value = _ROWS[name]
    a, b = (_NAN if pair is None else value(pair) for pair in (of_a, of_b))
    signed_form = form.replace("{:", "{:+")
    return _number(a, form), _number(b, form), _number(b - a, signed_form)


def _number(value: float, form: str) -> str:
    return "–" if math.isnan(value) else signed(value, form)
