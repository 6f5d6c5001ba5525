"""What the numbers say beside the paper's, in words."""

import re
from collections import Counter
from collections.abc import Iterator

from app.study.paper import LABELS, experiment_label, method_label, paper_numbers
from app.study.plan import Plan
from app.study.rows import Row, cell, mean, mean_of, speeds_of, values
from app.study.work import SWEPT_SCENARIO
from recordings.simulation import SPEEDS

_FACTOR = 1.5
"""The pattern holds where errors are within this factor of the paper's."""
_BASELINE_ANGLE = 50.0  # degrees, above which the baseline fails as it does in the paper
_FRAME = 1 / 15  # seconds, the paper's


def findings(plan: Plan, rows: list[Row]) -> list[str]:
    """Sentences, in the order of the tables."""
    return [
        *_missing(plan, rows),
        *_against_paper(plan, rows),
        *_small_n(plan, rows),
        *_not_computed(plan, rows),
        *_where_paper_has_nothing(plan, rows),
    ]


def _missing(plan: Plan, rows: list[Row]) -> Iterator[str]:
    """Which of the paper's cells have no recordings."""
    for scenario, label in LABELS.items():
        there = speeds_of(rows, scenario)
        absent = [f"{speed:.2f}" for speed in SPEEDS if speed not in there]
        if len(absent) == len(SPEEDS):
            yield f"{label}: there are no recordings of it here."
        elif absent:
            yield f"{label}: there are no recordings at {', '.join(absent)} m/s here."


def _against_paper(plan: Plan, rows: list[Row]) -> Iterator[str]:
    """Means over the speeds that both have."""
    printed = paper_numbers().rows
    n = plan.parameters.n
    for scenario, method in dict.fromkeys(key[:2] for key in printed):
        if method not in plan.methods:
            continue
        label = experiment_label(scenario, method)
        cells = {
            speed: here
            for speed in speeds_of(rows, scenario)
            if (scenario, method, speed) in printed
            and values(here := cell(rows, scenario, method, speed, n), "angle_deg")
        }
        if not cells:
            continue
        angle = mean_of([mean(here, "angle_deg") or 0.0 for here in cells.values()]) or 0.0
        error = mean_of([mean(here, "velocity_error") or 0.0 for here in cells.values()]) or 0.0
        theirs = [printed[scenario, method, speed] for speed in cells]
        paper_angle = mean_of([p.angle_mean for p in theirs]) or 0.0
        paper_error = mean_of([p.velocity_mean for p in theirs]) or 0.0
        said = (
            f"{label}, mean over {_over(len(cells))}: {angle:.1f} deg and "
            f"{error:.3f} m/s; the paper has {paper_angle:.1f} deg and {paper_error:.3f} m/s"
        )
        if method == "baseline":
            fails = "above" if angle > _BASELINE_ANGLE else "not above"
            yield f"{said}. It is {fails} {_BASELINE_ANGLE:g} deg" + (
                ", so it fails here as it does there: it also moves the clusters that lie still."
                if angle > _BASELINE_ANGLE
                else ", and so does not fail here as it does there."
            )
            continue
        ratios = angle / paper_angle, error / paper_error
        yield f"{said}, of which these are {ratios[0]:.2f} and {ratios[1]:.2f} times: " + _judged(
            ratios, simulated=plan.recordings is None
        )


def _over(speeds: int) -> str:
    return f"{speeds} speeds" if speeds > 1 else "the one speed"


def _judged(ratios: tuple[float, float], *, simulated: bool) -> str:
    if max(ratios) > _FACTOR:
        return f"beyond {_FACTOR:g} times the paper's errors."
    within = f"within {_FACTOR:g} times the paper's errors"
    if min(ratios) > 1 / _FACTOR:
        return f"{within}."
    if not simulated:
        return f"{within}, and clearly smaller."
    return (
        f"{within}, and clearly smaller: the simulated scene is simpler than a laboratory; where "
        "the sensors are and what is true is known exactly there, and nothing moves by accident."
    )


def _small_n(plan: Plan, rows: list[Row]) -> Iterator[str]:
    """How detection falls for small n."""
    if not plan.sweep or not (speeds := speeds_of(rows, SWEPT_SCENARIO)):
        return
    delta = plan.parameters.delta
    for method in plan.methods:
        coverage = {
            n: found
            for n in sorted(plan.sweep)
            if (found := mean(_all_speeds(rows, method, n), "coverage")) is not None
        }
        if len(coverage) < 2:
            continue
        best = max(coverage, key=lambda n: coverage[n])
        first = min(coverage)
        said = (
            f"{method_label(method)}, coverage over n: {coverage[best]:.2f} at n = {best}, "
            f"{coverage[first]:.2f} at n = {first}"
        )
        if coverage[first] > 0.9 * coverage[best]:
            yield f"{said}; detection does not fall for small n."
        elif method == "paper":
            slow, fast = (speed * first * _FRAME for speed in (speeds[0], speeds[-1]))
            yield (
                f"{said}. In {first} frame{'s' if first > 1 else ''} of 1/15 s the mannequin goes "
                f"{slow:.3f} to {fast:.3f} m, and what moves by less than delta = {delta:g} m "
                "counts as stationary, so detection falls for small n. The paper's figure has "
                "errors there, so some of its clusters were displaced by more than they moved; "
                "noise that is independent from zone to zone, as here, averages out over a "
                "cluster and does not do that."
            )
        else:
            yield f"{said}: detection falls for small n."


def _all_speeds(rows: list[Row], method: str, n: int) -> list[Row]:
    speeds = speeds_of(rows, SWEPT_SCENARIO)
    return [row for speed in speeds for row in cell(rows, SWEPT_SCENARIO, method, speed, n)]


def _not_computed(plan: Plan, rows: list[Row]) -> Iterator[str]:
    """Which cells of the sweep could not be computed, and why."""
    speeds = speeds_of(rows, SWEPT_SCENARIO)
    for method in plan.methods:
        for n in sorted(plan.sweep):
            cells = {s: cell(rows, SWEPT_SCENARIO, method, s, n) for s in speeds}
            empty = [s for s, here in cells.items() if here and not values(here, "velocity_error")]
            if not empty:
                continue
            here = [row for s in empty for row in cells[s]]
            pairs = sum(values(here, "pairs"))
            at = f"{', '.join(f'{s:.2f}' for s in empty)} m/s"
            said = f"{method_label(method)} could not be computed at n = {n} and {at}"
            if not pairs:
                yield f"{said}: the object does not move for {n} frames, and no pair counts."
                continue
            far = ", ".join(f"{s * n * _FRAME:.2f}" for s in empty)
            reasons = [row.why.partition(": ")[2] for row in here if row.why]
            why = f" What became of it, for example: {_commonest(reasons)}" if reasons else ""
            yield (
                f"{said}: {pairs:.0f} pairs count, between whose clouds the object goes {far} m, "
                f"and no point got a flow.{why}"
            )


def _commonest(reasons: list[str]) -> str:
    """A reason of the kind that is most frequent; numbers within it differ from case to case."""
    kinds = [re.sub(r"\d+(\.\d+)?", "#", reason) for reason in reasons]
    kind = Counter(kinds).most_common(1)[0][0]
    return reasons[kinds.index(kind)]


def _where_paper_has_nothing(plan: Plan, rows: list[Row]) -> Iterator[str]:
    """The one cell of the sweep that the paper could not compute."""
    n, speed = 10, 0.30
    here = cell(rows, SWEPT_SCENARIO, "paper", speed, n)
    if n not in plan.sweep or not here:
        return
    said = f"At n = {n} and {speed:.2f} m/s, where the paper could compute nothing,"
    if found := values(here, "velocity_error"):
        yield (
            f"{said} {len(found)} of {len(here)} trials give some flow here, with a coverage of "
            f"{mean(here, 'coverage') or 0.0:.2f} over all of them."
        )
    else:
        yield f"{said} nothing can be computed here, either."
