"""Results as rows, one per recording and set of parameters, and statistics over trials."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from app.study.work import Outcome, Simulated
from estimator import Parameters

Value = float | int | str | None


@dataclass(frozen=True)
class Row:
    """A recording with one set of parameters.

    Attributes:
        name: of the recording.
        scenario: None where the recording does not say.
        speed: m/s, None where the recording does not say.
        trial: None where the recording does not say.
        noise: name of the noise model, None where it was not simulated.
        imperfections: names.
        parameters: of the estimate.
        metrics: {field of `Metrics`: value}, empty without truth.
    """

    name: str
    scenario: str | None
    speed: float | None
    trial: int | None
    noise: str | None
    imperfections: tuple[str, ...]
    parameters: Parameters
    metrics: dict[str, float | None]


def rows_of(outcomes: Iterable[Outcome]) -> list[Row]:
    """Every result as a row, in the order of the outcomes."""
    return [
        Row(
            outcome.source.name,
            outcome.scenario,
            outcome.speed,
            outcome.trial,
            outcome.noise,
            outcome.source.imperfections if isinstance(outcome.source, Simulated) else (),
            result.parameters,
            result.metrics or {},
        )
        for outcome in outcomes
        for result in outcome.results
    ]


def values(rows: Iterable[Row], metric: str) -> list[float]:
    """A metric of those rows in which it is defined."""
    found = (row.metrics.get(metric) for row in rows)
    return [float(value) for value in found if value is not None]


def mean(rows: Iterable[Row], metric: str) -> float | None:
    """Mean of a metric over the rows in which it is defined, None where there is none."""
    found = values(rows, metric)
    return math.fsum(found) / len(found) if found else None


def std(rows: Iterable[Row], metric: str) -> float | None:
    """Sample standard deviation (n - 1), None where fewer than two rows define the metric."""
    found = values(rows, metric)
    return float(np.std(found, ddof=1)) if len(found) > 1 else None
