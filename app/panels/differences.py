"""Differences between two estimates of one frame, as HTML tables."""

from collections.abc import Callable
from html import escape

from app.analysis.pairs import Pair
from app.panels.tables import PLOTTED, TableRow, metric_label, number, table
from estimator import METRIC_INFO, PARAMETER_INFO, Label, Parameters, all_methods, values_of

_NAN = float("nan")


def _labelled(label: Label) -> Callable[[Pair], float]:
    return lambda pair: float((pair.flow.label == label).sum()) if pair.flow else _NAN


def _error(name: str) -> Callable[[Pair], float]:
    return lambda pair: getattr(errors, name) if (errors := pair.errors) else _NAN


_ROWS: dict[str, tuple[str, Callable[[Pair], float]]] = {
    "Moving": (".0f", _labelled(Label.MOVING)),
    "Stationary": (".0f", _labelled(Label.STATIONARY)),
    "Unassigned": (".0f", _labelled(Label.UNASSIGNED)),
    "Clusters": (".0f", lambda pair: len(pair.flow.clusters) if pair.flow else _NAN),
    **{metric_label(name): (METRIC_INFO[name].spec, _error(name)) for name in PLOTTED},
}
"""{quantity: format, function from a pair to its value}; NaN where undefined."""


def difference_table(of_a: Pair | None, of_b: Pair | None) -> str:
    """Table of numbers with A, with B, and B - A; a dash where unknown."""
    rows = [TableRow((name, *_cells(name, of_a, of_b))) for name in _ROWS]
    return table(("", "A", "B", "B − A"), rows)


def changes(of_a: Parameters, of_b: Parameters) -> str:
    """List of the parameters in which A and B differ."""
    a, b = values_of(of_a), values_of(of_b)
    differing = [
        f"{label}: {_written(a[name])} → {_written(b[name])}"
        for name, label in _labels().items()
        if a[name] != b[name]
    ]
    if not differing:
        return "<div>B has the same parameters as A.</div>"
    return f"<div>From A to B: {escape(', '.join(differing))}</div>"


def _labels() -> dict[str, str]:
    """{parameter: its symbol, or its name} of all methods."""
    infos = PARAMETER_INFO | {n: i for method in all_methods() for n, i in method.infos().items()}
    return {name: info.symbol or name for name, info in infos.items()}


def _written(value: object) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


def _cells(name: str, of_a: Pair | None, of_b: Pair | None) -> tuple[str, str, str]:
    form, value = _ROWS[name]
    a, b = (_NAN if pair is None else value(pair) for pair in (of_a, of_b))
    signed_form = f"+{form.removeprefix('+')}"
    return number(a, form), number(b, form), number(b - a, signed_form)
