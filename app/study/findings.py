"""Findings of the study against the paper, as sentences."""

import re
from collections import Counter
from collections.abc import Iterator
from statistics import median

from app.study.paper import (
    FRAME,
    LABELS,
    PaperRow,
    experiment_label,
    method_label,
    paper_numbers,
)
from app.study.plan import Plan
from app.study.ranges import span
from app.study.rows import Row, cell, mean, mean_of, speeds_of, std, values
from app.study.work import SWEPT_SCENARIO
from recordings.simulation import SPEEDS

_FACTOR = 1.5
"""Errors within this factor of the paper's count as reproduced."""
_BASELINE_ANGLE = 50.0  # degrees, above which the baseline fails as in the paper
_FAR = 3.0
"""A trial is an outlier above this multiple of its cell's median error."""
_PAPER_SMALL_N = (
    " The paper's figure has errors there, so some of its clusters were displaced by more than "
    "they moved. Noise that differs from zone to zone averages out over a cluster and cannot do "
    "that; errors that many zones share can."
)
_TREND = 1.25
"""Errors rise or fall over the speeds if the last and first differ by more than this factor."""


def findings(plan: Plan, rows: list[Row]) -> list[str]:
    """All findings as sentences, in the order of the tables."""
    return [
        *_missing(plan, rows),
        *_same_cell(plan, rows),
        *_against_paper(plan, rows),
        *_outlying(plan, rows),
        *_small_n(plan, rows),
        *_not_computed(plan, rows),
        *_cell_missing_in_paper(plan, rows),
    ]


def _missing(plan: Plan, rows: list[Row]) -> Iterator[str]:
    """Cells of the paper's tables without recordings."""
    if not any(speeds_of(rows, scenario) for scenario in LABELS):
        yield "None of the paper's experiments is among these recordings."
        return
    for scenario, label in LABELS.items():
        there = speeds_of(rows, scenario)
        absent = [f"{speed:.2f}" for speed in SPEEDS if speed not in there]
        if len(absent) == len(SPEEDS):
            yield f"{label}: there are no recordings of it here."
        elif absent:
            yield f"{label}: there are no recordings at {', '.join(absent)} m/s here."


def _same_cell(plan: Plan, rows: list[Row]) -> Iterator[str]:
    """Recordings with equal scenario, speed and trial."""
    names: dict[tuple[str, float, int], dict[str, None]] = {}
    for row in rows if plan.recordings else ():
        if row.scenario is not None and row.speed is not None and row.trial is not None:
            names.setdefault((row.scenario, row.speed, row.trial), {})[row.source.name] = None
    for (scenario, speed, trial), found in names.items():
        if len(found) > 1:
            yield (
                f"{', '.join(found)} all say {scenario}, {speed:.2f} m/s, trial {trial}, and "
                "differ: each counts as a trial."
            )


def _against_paper(plan: Plan, rows: list[Row]) -> Iterator[str]:
    """Mean errors beside the paper's, over the speeds that both cover."""
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
        angles = [mean(here, "angle_deg") or 0.0 for here in cells.values()]
        angle = mean_of(angles) or 0.0
        error = mean_of([mean(here, "velocity_error") or 0.0 for here in cells.values()]) or 0.0
        published = [printed[scenario, method, speed] for speed in cells]
        paper_angle = mean_of([p.angle_mean for p in published]) or 0.0
        paper_error = mean_of([p.velocity_mean for p in published]) or 0.0
        sentence = (
            f"{label}, mean over {_over(len(cells))}: {angle:.1f} deg and "
            f"{error:.3f} m/s; the paper has {paper_angle:.1f} deg and {paper_error:.3f} m/s"
        )
        if method == "baseline":
            fails = "above" if angle > _BASELINE_ANGLE else "not above"
            yield f"{sentence}. It is {fails} {_BASELINE_ANGLE:g} deg" + (
                ", so it fails here as it does there: it also moves the clusters that lie still."
                if angle > _BASELINE_ANGLE
                else ", and so does not fail here as it does there."
            )
            yield from _spread(
                label, [std(here, "angle_deg") for here in cells.values()], published
            )
            continue
        ratios = angle / paper_angle, error / paper_error
        yield (
            f"{sentence}; ours are {ratios[0]:.2f} and {ratios[1]:.2f} times as large: "
            + _judged(ratios, simulated=plan.recordings is None)
        )
        yield from _trend(label, angles, published)


def _spread(label: str, ours: list[float | None], published: list[PaperRow]) -> Iterator[str]:
    """Spread over trials beside the paper's."""
    found = [deviation for deviation in ours if deviation is not None]
    if not found:
        return
    printed = [p.angle_std for p in published]
    smaller = max(found) < min(printed)
    yield (
        f"{label}, std of the angle deviation over trials: {span(found, '.1f')} deg; the paper "
        f"has {span(printed, '.1f')} deg"
        + (
            ". Trials differ less here than in the paper; the reason is not known."
            if smaller
            else "."
        )
    )


def _trend(label: str, ours: list[float], published: list[PaperRow]) -> Iterator[str]:
    """Trend of the errors over speed beside the paper's, where the paper has one."""
    printed = [p.angle_mean for p in published]
    if len(ours) < 3 or (there := _course(printed)) == "stays":
        return
    here = _course(ours)
    yield (
        f"{label}, angle deviation from the slowest to the fastest: the paper's {there} "
        f"({', '.join(f'{a:.1f}' for a in printed)} deg); here it "
        f"{here + ', too' if here == there else here} ({', '.join(f'{a:.1f}' for a in ours)} deg)"
        + ("." if here == there else "; the reason for the difference is not known.")
    )


def _course(found: list[float]) -> str:
    if found[-1] > _TREND * found[0]:
        return "rises"
    return "falls" if found[0] > _TREND * found[-1] else "stays"


def _outlying(plan: Plan, rows: list[Row]) -> Iterator[str]:
    """Outliers among the trials of a cell, which dominate its mean, with their diagnosis."""
    printed = paper_numbers().rows
    for scenario, method, speed in printed:
        if method not in plan.methods or method == "baseline":
            continue
        here = cell(rows, scenario, method, speed, plan.parameters.n)
        errors = values(here, "velocity_error")
        if len(errors) < 3:
            continue
        middle, angle = median(errors), median(values(here, "angle_deg"))
        for row in here:
            error = row.metrics.get("velocity_error")
            if error is None:
                continue
            diagnosis = f" {row.diagnosis}" if row.diagnosis else ""
            label = f"{experiment_label(scenario, method)} at {speed:.2f} m/s: trial {row.trial}"
            has = f"{row.metrics.get('angle_deg') or 0.0:.1f} deg and {error:.3f} m/s"
            if error > _FAR * middle:
                yield (
                    f"{label} alone has {has}, where the median of the trials is {angle:.1f} deg "
                    f"and {middle:.3f} m/s; it decides mean and std of its cell.{diagnosis}"
                )
            elif diagnosis:
                yield f"{label} has {has}.{diagnosis}"


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
        f"{within}, and clearly smaller. The reason is not known: these recordings are simulated, "
        "and nothing here tests how the simulation is easier than the laboratory."
    )


def _small_n(plan: Plan, rows: list[Row]) -> Iterator[str]:
    """Coverage at small n."""
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
        sentence = f"{method_label(method)}, coverage over n: {coverage[best]:.2f} at n = {best}"
        if first != best:
            sentence += f", {coverage[first]:.2f} at n = {first}"
        if coverage[first] > 0.9 * coverage[best]:
            yield f"{sentence}; detection does not fall for small n."
        elif method == "paper":
            distances = span([speed * first * FRAME for speed in speeds], ".3f")
            yield (
                f"{sentence}. In {first} frame{'s' if first > 1 else ''} of 1/15 s the mannequin "
                f"goes {distances} m, and what moves by less than delta = {delta:g} m "
                f"counts as stationary, so detection falls for small n.{_PAPER_SMALL_N}"
            )
        else:
            yield f"{sentence}: detection falls for small n."


def _all_speeds(rows: list[Row], method: str, n: int) -> list[Row]:
    speeds = speeds_of(rows, SWEPT_SCENARIO)
    return [row for speed in speeds for row in cell(rows, SWEPT_SCENARIO, method, speed, n)]


def _not_computed(plan: Plan, rows: list[Row]) -> Iterator[str]:
    """Cells of the sweep that could not be computed, with the reason."""
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
            sentence = f"{method_label(method)} could not be computed at n = {n} and {at}"
            if not pairs:
                yield f"{sentence}: the object does not move for {n} frames, and no pair counts."
                continue
            far = ", ".join(f"{s * n * FRAME:.2f}" for s in empty)
            reasons = [row.diagnosis.partition(": ")[2] for row in here if row.diagnosis]
            diagnosis = f" Example: {_commonest(reasons)}" if reasons else ""
            yield (
                f"{sentence}: {pairs:.0f} pairs count, between whose clouds the object goes {far} "
                f"m, and no point got a flow.{diagnosis}"
            )


def _commonest(reasons: list[str]) -> str:
    """An example of the most frequent reason, numbers in it disregarded."""
    kinds = [re.sub(r"\d+(\.\d+)?", "#", reason) for reason in reasons]
    kind = Counter(kinds).most_common(1)[0][0]
    return reasons[kinds.index(kind)]


def _cell_missing_in_paper(plan: Plan, rows: list[Row]) -> Iterator[str]:
    """The cell of the sweep that the paper could not compute."""
    n, speed = 10, 0.30
    here = cell(rows, SWEPT_SCENARIO, "paper", speed, n)
    if n not in plan.sweep or not here:
        return
    found = values(here, "velocity_error")
    coverage = {
        m: mean(there, "coverage")
        for m in sorted(plan.sweep)
        if (there := cell(rows, SWEPT_SCENARIO, "paper", speed, m))
    }
    falling = ", ".join(f"{c:.2f} at n = {m}" for m, c in coverage.items() if m > 5 and c)
    reach = plan.parameters.max_correspondence_distance
    silent = [row for row in here if not row.metrics.get("points_with_flow")]
    reasons = [row.diagnosis.partition(": ")[2] for row in silent if row.diagnosis]
    yield (
        f"At n = {n} and {speed:.2f} m/s the paper could compute nothing: the two clouds of the "
        "object are too far apart to share clusters. Here "
        f"{len(found)} of {len(here)} trials give some flow; coverage at this speed is "
        f"{falling or 'zero'}. Between the clouds the object goes {speed * n * FRAME:.2f} m, and "
        f"ICP pairs points within {reach:g} m, so that flow remains only where one part of the "
        "object comes to lie near where another was."
        + (f" The trials without any say: {_commonest(reasons)}" if reasons else "")
    )
