"""Differences between two sets of parameters, in a frame and over the recording, as HTML tables."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape

import numpy as np

from app.analysis.comparison import A, B
from app.analysis.pairs import Pair
from app.analysis.quantities import QUANTITIES
from app.analysis.survey import Survey
from app.panels.tables import PLOTTED, TableRow, number, table
from estimator import METRIC_INFO, PARAMETER_INFO, Label, Parameters, all_methods, values_of

_NAN = float("nan")
_COUNTED = ("moving", "stationary", "unassigned", "clusters")
_ROWS = (*PLOTTED, *_COUNTED)  # what decides comes first
_LABELS = {"moving": Label.MOVING, "stationary": Label.STATIONARY, "unassigned": Label.UNASSIGNED}

Numbers = Mapping[str, float]
"""{quantity: value}, NaN where undefined."""


@dataclass(frozen=True)
class Totals:
    """Numbers of a side over the whole recording, as far as it is computed.

    Attributes:
        numbers: sums of what is counted, and pooled errors.
        counting: number of pairs that count, and of all, in words.
        complete: whether every frame is computed.
    """

    numbers: Numbers
    counting: str
    complete: bool


def totals(survey: Survey) -> Totals:
    """The totals of a survey."""
    metrics = survey.summary()
    sums = {name: float(np.nansum(getattr(survey, name))) for name in _COUNTED}
    return Totals(
        sums | {name: getattr(metrics, name) for name in PLOTTED},
        f"{np.count_nonzero(survey.counts)} of {survey.pairs}",
        survey.complete,
    )


def numbers_of(pair: Pair | None) -> Numbers:
    """The numbers of one pair."""
    if pair is None or pair.flow is None:
        return {}
    flow, errors = pair.flow, pair.errors
    counted = {name: float(np.count_nonzero(flow.label == of)) for name, of in _LABELS.items()}
    counted["clusters"] = len(flow.clusters)
    return counted | {n: getattr(errors, n) if errors else _NAN for n in PLOTTED}


def difference_table(
    pairs: Mapping[str, Pair | None], whole: Mapping[str, Totals | None], counts: Mapping[str, str]
) -> str:
    """Table of A and B in this frame and over the whole recording, the better value bold.

    Numbers of the whole recording are there once both sides are computed.

    Args:
        pairs: {A or B: its pair in this frame, None where it is not estimated}.
        whole: {A or B: its totals, None before there are any}.
        counts: {A or B: whether its pair counts in the means, in words}.
    """
    of_frame = {side: numbers_of(pair) for side, pair in pairs.items()}
    # A part of one side beside the whole of the other would mislead.
    complete = all(known is not None and known.complete for known in whole.values())
    of_whole = {side: known.numbers if known and complete else {} for side, known in whole.items()}
    rows = [
        TableRow(
            (
                QUANTITIES[name].label.removesuffix(" points"),
                *_cells(name, of_frame, marked=True),
                *_cells(name, of_whole, marked=complete),
            )
        )
        for name in _ROWS
    ]
    counting = [known.counting if known else "–" for known in whole.values()]
    rows.append(TableRow(("Pairs that count", *counts.values(), *counting)))
    groups = (("", 1), ("This frame", 2), ("Whole recording", 2))
    return table(("", A, B, A, B), rows, groups)


def verdict(whole: Mapping[str, Totals | None]) -> str:
    """Sentences on which of A and B is better over the whole recording, "" until it is known.

    Args:
        whole: {A or B: its totals, None before there are any}.
    """
    both = {side: of for side, of in whole.items() if of is not None and of.complete}
    if len(both) < 2:
        return ""
    known = {side: of.numbers for side, of in both.items()}
    return f"{_on_errors(known, _over(both))}{_on_moving(known)}"


def _over(both: Mapping[str, Totals]) -> str:
    """What the errors are the means of."""
    counting = {of.counting for of in both.values()}
    return f"the {counting.pop()} pairs that count" if len(counting) == 1 else "the whole recording"


def _on_moving(known: Mapping[str, Numbers]) -> str:
    """Sentence on how many points each side finds moving, "" if as many; no error tells of it."""
    of_a, of_b = (known[side]["moving"] for side in (A, B))
    if of_a == of_b:
        return ""
    return f" In all pairs A finds {of_a:.0f} moving points, B {of_b:.0f}."


def _on_errors(known: Mapping[str, Numbers], over: str) -> str:
    better: dict[str, list[str]] = {A: [], B: []}
    for name in PLOTTED:
        if side := _better(name, known):
            better[side].append(METRIC_INFO[name].title)
    if all(np.isnan(numbers[name]) for numbers in known.values() for name in PLOTTED):
        return "No pair counts, so no error says which is better."
    if not any(better.values()):
        return f"Over {over} A and B are equally good."
    if all(better.values()):
        return f"Over {over} <b>A is better in {_listed(better[A])}, B in {_listed(better[B])}</b>."
    side = A if better[A] else B
    rest = "" if len(better[side]) == len(PLOTTED) else "; the rest is equal"
    return f"Over {over} <b>{side} is better</b>, in {_listed(better[side])}{rest}."


def other_pairs(whole: Mapping[str, Totals | None]) -> str:
    """Sentence for means that are of different numbers of pairs, after the verdict; else ""."""
    counting = [of.counting for of in whole.values() if of is not None and of.complete]
    if len(set(counting)) < 2:
        return ""
    of_a, of_b = counting
    return f" The means are not of the same pairs: {of_a} count for A, {of_b} for B."


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


def _cells(name: str, sides: Mapping[str, Numbers], *, marked: bool) -> tuple[str, str]:
    """The values of A and B; a hint says their difference."""
    form = QUANTITIES[name].spec
    a, b = (sides[side].get(name, _NAN) for side in (A, B))
    written = [number(value, form) for value in (a, b)]
    if marked and (better := _better(name, sides)):
        at = (A, B).index(better)
        written[at] = f"<b>{written[at]}</b>"
    difference = number(b - a, f"+{form.removeprefix('+')}")
    return written[0], f'<span title="B − A: {difference}">{written[1]}</span>'


def _better(name: str, sides: Mapping[str, Numbers]) -> str | None:
    """A or B, whichever is better by a metric as it is written; None for neither."""
    if name not in METRIC_INFO:
        return None
    values = [sides[side].get(name, _NAN) for side in (A, B)]
    ranks = [METRIC_INFO[name].rank(value) for value in values]
    written = {number(value, QUANTITIES[name].spec) for value in values}
    if len(written) < 2 or ranks[0] == ranks[1] or np.isnan(ranks).any():
        return None
    return (A, B)[int(np.argmin(ranks))]


def _listed(words: Sequence[str]) -> str:
    """Words as a list in a sentence."""
    *others, last = words
    return f"{', '.join(others)} and {last}" if others else last
