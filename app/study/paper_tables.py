"""Tables I and II in the paper's layout, each cell beside the paper's."""

from itertools import product

from app.study.paper import experiment_label, paper_numbers
from app.study.plan import Plan
from app.study.rows import Row, Value, mean, std
from app.study.table import Column, Table
from recordings.simulation import SPEEDS

_ANGLE, _VELOCITY = "Angle deviation (deg)", "Linear velocity error (m/s)"
_COLUMNS = (
    Column("experiment", "Experiment"),
    Column("speed", "Target speed (m/s)", ".2f"),
    Column("angle_mean", "mean", ".3f", _ANGLE),
    Column("paper_angle_mean", "paper", ".3f", _ANGLE),
    Column("angle_std", "std", ".3f", _ANGLE),
    Column("paper_angle_std", "paper", ".3f", _ANGLE),
    Column("velocity_mean", "mean", ".3f", _VELOCITY),
    Column("paper_velocity_mean", "paper", ".3f", _VELOCITY),
    Column("velocity_std", "std", ".3f", _VELOCITY),
    Column("paper_velocity_std", "paper", ".3f", _VELOCITY),
    Column("coverage", "Coverage", ".2f"),
    Column("precision", "Precision", ".2f"),
    Column("trials", "Trials", "d"),
)
_NOTE = (
    "Mean and sample standard deviation over the trials of each recording's mean over points and "
    "time; trials: recordings in which a point got a flow, of those that there are."
)


def table_1(plan: Plan, rows: list[Row]) -> Table:
    """The y-axis experiment with every method."""
    return _table(plan, rows, "table_1", "The y-axis experiment", ("towards",))


def table_2(plan: Plan, rows: list[Row]) -> Table:
    """The x-axis experiment and the one in which the robot moves, too."""
    title = "The x-axis experiment, and the y-axis with both robots moving"
    return _table(plan, rows, "table_2", title, ("sideways", "robot_moving"))


def _table(plan: Plan, rows: list[Row], name: str, title: str, scenarios: tuple[str, ...]) -> Table:
    speeds = sorted({*SPEEDS, *(r.speed for r in rows if r.speed and r.scenario in scenarios)})
    cells = product(scenarios, plan.methods, speeds)
    return Table(
        name,
        title,
        _NOTE,
        _COLUMNS,
        tuple(_row(rows, plan.parameters.n, *cell) for cell in cells),
    )


def _row(rows: list[Row], n: int, scenario: str, method: str, speed: float) -> dict[str, Value]:
    here = cell(rows, n, scenario, method, speed)
    row: dict[str, Value] = {
        "experiment": experiment_label(scenario, method),
        "speed": speed,
        "coverage": mean(here, "coverage"),
        "precision": mean(here, "precision"),
        "trials": len(here),
    }
    printed = paper_numbers().rows.get((scenario, method, speed))
    for key, metric in (("angle", "angle_deg"), ("velocity", "velocity_error")):
        row[f"{key}_mean"], row[f"{key}_std"] = mean(here, metric), std(here, metric)
        for statistic in ("mean", "std"):
            row[f"paper_{key}_{statistic}"] = (
                getattr(printed, f"{key}_{statistic}") if printed else None
            )
    return row


def cell(rows: list[Row], n: int, scenario: str, method: str, speed: float) -> list[Row]:
    """The trials of one cell, in their order."""
    here = [
        row
        for row in rows
        if (row.scenario, row.speed) == (scenario, speed)
        and (row.parameters.method, row.parameters.n) == (method, n)
    ]
    return sorted(here, key=lambda row: (row.trial or 0, row.name))
