"""Results as rows, one per recording and parameter set, and statistics over trials."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from app.study.work import Outcome, Source
from estimator import Parameters

Value = float | int | str | None


@dataclass(frozen=True)
class Row:
    """Result of a recording with one set of parameters.

    Attributes:
        source: the recording.
        scenario: None where unknown.
        speed: m/s, None where unknown.
        trial: None where unknown.
        parameters: of the estimate.
        metrics: {field of `Metrics`: value}, empty without truth.
        diagnosis: see `Result`.
    """

    source: Source
    scenario: str | None
    speed: float | None
    trial: int | None
    parameters: Parameters
    metrics: dict[str, float | None]
    diagnosis: str | None = None


def rows_of(outcomes: Iterable[Outcome]) -> list[Row]:
    """Every result as a row, in the order of the outcomes."""
    return [
        Row(
            outcome.source,
            outcome.scenario,
            outcome.speed,
            outcome.trial,
            result.case.parameters,
            result.metrics or {},
            result.diagnosis,
        )
        for outcome in outcomes
        for result in outcome.results
    ]


def cell(rows: Iterable[Row], scenario: str, method: str, speed: float, n: int) -> list[Row]:
    """Rows of one cell of a table, in the order of trials."""
    here = [
        row
        for row in rows
        if (row.scenario, row.speed) == (scenario, speed)
        and (row.parameters.method, row.parameters.n) == (method, n)
    ]
    return sorted(here, key=lambda row: (row.trial or 0, row.source.name))


def speeds_of(rows: Iterable[Row], scenario: str) -> list[float]:
    """Speeds of a scenario's recordings, m/s, ascending."""
    return sorted({r.speed for r in rows if r.scenario == scenario and r.speed is not None})


def values(rows: Iterable[Row], metric: str) -> list[float]:
    """Values of a metric in the rows that define it."""
    found = (row.metrics.get(metric) for row in rows)
    return [float(value) for value in found if value is not None]


def mean(rows: Iterable[Row], metric: str) -> float | None:
    """Mean of a metric over the rows that define it, None without any."""
    return mean_of(values(rows, metric))


def mean_of(found: list[float]) -> float | None:
    """Mean, None for an empty list."""
    return math.fsum(found) / len(found) if found else None


def std(rows: Iterable[Row], metric: str) -> float | None:
    """Sample standard deviation (n - 1), None if fewer than two rows define it."""
    found = values(rows, metric)
    return float(np.std(found, ddof=1)) if len(found) > 1 else None
