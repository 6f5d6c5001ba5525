"""Tables beyond the paper's: scenarios, the field's metrics, sweep, ablation, recordings."""

from collections.abc import Iterable, Iterator
from itertools import product

from app.study.conditions import definitions, truth_frame_text
from app.study.paper import FRAME, LABELS, experiment_label
from app.study.plan import Plan
from app.study.ranges import span
from app.study.rows import Row, Value, cell, mean, mean_of, speeds_of, std, values
from app.study.table import Column, Table
from app.study.work import SWEPT_SCENARIO, Simulated
from estimator import ERROR_SYMBOLS, METRIC_INFO
from recordings.simulation import IMPERFECTIONS, PAPER_SCENARIOS, SCENARIOS

_COUNTS = tuple(key for key, info in METRIC_INFO.items() if info.kind == "count")
_PAPERS = ("angle_deg", "velocity_error")
_FOUND = ("coverage", "precision", "false_flow")
_METRICS = {key: Column(key, info.heading, info.spec) for key, info in METRIC_INFO.items()}


def scenarios_table(plan: Plan, rows: list[Row]) -> Table | None:
    """Table of the scenarios that are not the paper's; None without any."""
    names = [
        name
        for name in dict.fromkeys(row.scenario for row in rows if row.scenario)
        if name not in PAPER_SCENARIOS
    ]
    if not names:
        return None
    lines: list[dict[str, Value]] = []
    for scenario, method in product(names, plan.methods):
        for speed in speeds_of(rows, scenario):
            here = cell(rows, scenario, method, speed, plan.parameters.n)
            line: dict[str, Value] = {
                "experiment": experiment_label(scenario, method),
                "speed": speed,
                "trials": len(here),
            }
            for key in (*_PAPERS, *_FOUND):
                line[key] = mean(here, key)
                if key in _PAPERS:
                    line[f"{key}_std"] = std(here, key)
            lines.append(line)
    texts = "; ".join(f"{name}: {SCENARIOS[name].text}" for name in names if name in SCENARIOS)
    return Table(
        "scenarios",
        "Scenarios beyond the paper's",
        "Means and sample deviations over trials. Angle deviation and velocity error compare every "
        "flow with the motion of the target alone, its turning included, such as that of the one "
        f"in front of two that cross; the others know what every point does. {definitions(_FOUND)} "
        "Where nothing moves every flow is false, and only false flow is defined."
        f"{f' {texts}.' if texts else ''}",
        (
            Column("experiment", "Scenario"),
            Column("speed", "Speed (m/s)", ".2f"),
            *_with_std(_PAPERS),
            *(_METRICS[key] for key in _FOUND),
            Column("trials", "Trials", "d"),
        ),
        tuple(lines),
    )


def _with_std(keys: Iterable[str]) -> Iterator[Column]:
    for key in keys:
        yield _METRICS[key]
        if key in _PAPERS:
            yield Column(f"{key}_std", "std", METRIC_INFO[key].form)


def metrics_table(plan: Plan, rows: list[Row]) -> Table:
    """Table of the field's metrics per experiment, means over trials."""
    shown = [key for key in METRIC_INFO if key not in _PAPERS]
    lines: list[dict[str, Value]] = []
    scenarios = list(dict.fromkeys(row.scenario for row in rows if row.scenario))
    for scenario, method in product(scenarios, plan.methods):
        for speed in speeds_of(rows, scenario):
            here = cell(rows, scenario, method, speed, plan.parameters.n)
            line: dict[str, Value] = {
                "experiment": experiment_label(scenario, method),
                "speed": speed,
            }
            for key in shown:
                found = values(here, key)
                line[key] = round(sum(found)) if key in _COUNTS and found else mean_of(found)
            lines.append(line)
    speeds = {speed for scenario in scenarios for speed in speeds_of(rows, scenario) if speed}
    distances = [plan.parameters.n * FRAME * speed for speed in speeds]
    these = f" than the {span(distances, '.2f')} m of these pairs" if distances else ""
    return Table(
        "metrics",
        "The field's metrics",
        f"Means over trials; pairs and points are sums. {definitions(shown)} Here "
        f"{ERROR_SYMBOLS}; thresholds of AccS, AccR and outliers were made for longer "
        f"displacements{these}, so that a point at rest, or without a flow, often counts as "
        "accurate. Read them with coverage and precision."
        f"{truth_frame_text(plan)}",
        (
            Column("experiment", "Experiment"),
            Column("speed", "Speed (m/s)", ".2f"),
            *(_METRICS[key] for key in shown),
        ),
        tuple(lines),
    )


def sweep_table(plan: Plan, rows: list[Row]) -> Table | None:
    """Table of the error over n, as a share of the target speed; None without a sweep."""
    speeds = speeds_of(rows, SWEPT_SCENARIO)
    if not plan.sweep or not speeds:
        return None
    columns = [Column("method", "Method"), Column("n", "n", "d")]
    for speed in speeds:
        group = f"{speed:.2f} m/s"
        columns += [
            Column(f"error_percent_{speed:.2f}", "error (%)", ".1f", group),
            Column(f"coverage_{speed:.2f}", "coverage", ".2f", group),
            Column(f"trials_{speed:.2f}", "trials", "", group),
        ]
    lines: list[dict[str, Value]] = []
    for method, n in product(plan.methods, sorted(plan.sweep)):
        line: dict[str, Value] = {"method": method, "n": n}
        for speed in speeds:
            here = cell(rows, SWEPT_SCENARIO, method, speed, n)
            line[f"error_percent_{speed:.2f}"] = error_percent(here)
            line[f"coverage_{speed:.2f}"] = mean(here, "coverage")
            line[f"trials_{speed:.2f}"] = f"{len(values(here, 'velocity_error'))}/{len(here)}"
        lines.append(line)
    return Table(
        "sweep",
        "The sweep of n in the y-axis experiment",
        "Error: linear velocity error, mean over points and time, then over the trials in which a "
        "point got a flow, as a share of the target speed. Where no trial gave a flow it could not "
        "be computed and is shown as a dash. Trials: those with a flow, of all there are.",
        tuple(columns),
        tuple(lines),
    )


def error_percent(trials: list[Row]) -> float | None:
    """Linear velocity error of one cell as a share of its speed, in percent."""
    error = mean(trials, "velocity_error")
    return 100 * error / trials[0].speed if error is not None and trials[0].speed else None


def ablation_table(plan: Plan, rows: list[Row]) -> Table | None:
    """Table of the errors per noise model and imperfection; None without `--ablation`."""
    if not plan.ablation:
        return None
    lines: list[dict[str, Value]] = []
    for (noise, imperfections), method in product(plan.conditions(), plan.methods):
        here = [
            row
            for row in rows
            if isinstance(row.source, Simulated)
            and (row.source.noise, row.source.imperfections) == (noise, imperfections)
            and row.parameters.method == method
        ]
        line: dict[str, Value] = {
            "noise": noise,
            "imperfection": " ".join(imperfections) or "none",
            "method": method,
            "angle_deg_std": std(here, "angle_deg"),
            "velocity_error_std": std(here, "velocity_error"),
        }
        lines.append(line | {key: mean(here, key) for key in METRIC_INFO if key not in _COUNTS})
    first = plan.ablation_sources()[0]
    assert isinstance(first, Simulated)
    trials = len({row.trial for row in rows})
    columns = [Column(key, key.capitalize()) for key in ("noise", "imperfection", "method")]
    columns += _with_std(key for key in METRIC_INFO if key not in _COUNTS)
    return Table(
        "ablation",
        "What noise models and imperfections do to the errors",
        f"A part of the study: {LABELS.get(first.scenario, first.scenario)} experiment at "
        f"{first.speed:g} m/s, trials 1 to {trials}, n = {plan.parameters.n}. Each noise model "
        f"without imperfections, then each imperfection alone with the noise model {plan.noise}"
        f"{': ' + '; '.join(f'{i.name}, {i.text}' for i in IMPERFECTIONS.values())}.",
        tuple(columns),
        tuple(lines),
    )


def recordings_table(plan: Plan, rows: list[Row]) -> Table:
    """Table of every metric of every recording."""
    columns = (
        Column("recording", "Recording"),
        Column("scenario", "Scenario"),
        Column("speed", "Speed (m/s)", ".2f"),
        Column("trial", "Trial", "d"),
        Column("method", "Method"),
        *_METRICS.values(),
    )
    lines: list[dict[str, Value]] = [
        {
            "recording": row.source.name,
            "scenario": row.scenario,
            "speed": row.speed,
            "trial": row.trial,
            "method": row.parameters.method,
            **{key: row.metrics.get(key) for key in METRIC_INFO},
        }
        for row in rows
        if row.parameters.n == plan.parameters.n
    ]
    note = (
        "One line per recording and method; means over all its points and pairs."
        f"{truth_frame_text(plan)}"
    )
    return Table("recordings", "Every recording", note, columns, tuple(lines))
