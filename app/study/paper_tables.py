"""Tables I and II in the paper's layout, with the paper's values beside ours."""

from itertools import product

from app.study.conditions import definitions, truth_frame_text
from app.study.paper import experiment_label, paper_numbers
from app.study.plan import Plan
from app.study.rows import Row, Value, cell, mean, speeds_of, std, values
from app.study.table import Column, Table
from recordings.simulation import SPEEDS

_ANGLE, _VELOCITY = "Angle deviation (deg)", "Linear velocity error (m/s)"
_COLUMNS = (
    Column("experiment", "Experiment"),
    Column("speed", "Speed (m/s)", ".2f"),
    Column("angle_mean", "mean", ".3f", _ANGLE),
    Column("paper_angle_mean", "paper mean", ".3f", _ANGLE, from_paper=True),
    Column("angle_std", "std", ".3f", _ANGLE),
    Column("paper_angle_std", "paper std", ".3f", _ANGLE, from_paper=True),
    Column("velocity_mean", "mean", ".3f", _VELOCITY),
    Column("paper_velocity_mean", "paper mean", ".3f", _VELOCITY, from_paper=True),
    Column("velocity_std", "std", ".3f", _VELOCITY),
    Column("paper_velocity_std", "paper std", ".3f", _VELOCITY, from_paper=True),
    Column("coverage", "Coverage", ".2f"),
    Column("precision", "Precision", ".2f"),
    Column("trials", "Trials"),
    Column("pairs", "Pairs", "d"),
)
_NOTE = (
    "Each recording gives a mean over all points with a flow and over time; mean and std (sample) "
    "are over recordings, the trials. Beside each stands the paper's. "
    f"{definitions(('coverage', 'precision'))} Trials: recordings in which a point got a flow, of "
    "all there are. Pairs: of frames at both of which the object moves, in all of the recordings."
)


def paper_tables(plan: Plan, rows: list[Row]) -> tuple[Table, Table]:
    """Table I (y-axis) and Table II (x-axis, robot moving), each with every method."""
    return (
        _table(
            plan, rows, "table_1", "The y-axis experiment, as in the paper's Table I", ("towards",)
        ),
        _table(
            plan,
            rows,
            "table_2",
            "The x-axis experiment, and both robots moving, as in the paper's Table II",
            ("sideways", "robot_moving"),
        ),
    )


def _table(plan: Plan, rows: list[Row], name: str, title: str, scenarios: tuple[str, ...]) -> Table:
    n = plan.parameters.n
    lines = [
        _row(rows, scenario, method, speed, n)
        for scenario, method in product(scenarios, plan.methods)
        for speed in sorted({*SPEEDS, *speeds_of(rows, scenario)})
    ]
    return Table(name, title, _NOTE + truth_frame_text(plan), _COLUMNS, tuple(lines))


def _row(rows: list[Row], scenario: str, method: str, speed: float, n: int) -> dict[str, Value]:
    here = cell(rows, scenario, method, speed, n)
    row: dict[str, Value] = {
        "experiment": experiment_label(scenario, method),
        "speed": speed,
        "coverage": mean(here, "coverage"),
        "precision": mean(here, "precision"),
        "trials": f"{len(values(here, 'velocity_error'))}/{len(here)}" if here else None,
        "pairs": round(sum(values(here, "pairs"))) if here else None,
    }
    printed = paper_numbers().rows.get((scenario, method, speed))
    for key, metric in (("angle", "angle_deg"), ("velocity", "velocity_error")):
        row[f"{key}_mean"], row[f"{key}_std"] = mean(here, metric), std(here, metric)
        for statistic in ("mean", "std"):
            published = getattr(printed, f"{key}_{statistic}") if printed else None
            row[f"paper_{key}_{statistic}"] = published
    return row
