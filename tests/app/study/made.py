"""Results made by hand."""

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

from app.study.plan import Plan
from app.study.rows import Row
from app.study.work import Simulated
from estimator import Parameters

PLAN = Plan(Parameters(), speeds=(0.15, 0.30), trials=(1, 2), sweep=(1, 8, 10))


def made(
    scenario: str = "towards",
    speed: float = 0.30,
    trial: int = 1,
    *,
    method: str = "paper",
    n: int = 8,
    noise: str = "paper",
    imperfections: tuple[str, ...] = (),
    diagnosis: str | None = None,
    metrics: Mapping[str, float | None] = MappingProxyType({}),
) -> Row:
    """A row; without metrics nothing got a flow."""
    undefined = {"angle_deg": None, "velocity_error": None, "coverage": 0.0, "precision": None}
    return Row(
        Simulated(scenario, speed, trial, noise=noise, imperfections=imperfections),
        scenario,
        speed,
        trial,
        replace(Parameters(), method=method, n=n),
        {"pairs": 7, "points_with_flow": 0, **undefined, **metrics},
        diagnosis,
    )


def good(angle_deg: float, velocity_error: float) -> dict[str, float | None]:
    """Metrics of a recording in which all is found."""
    return {
        "points_with_flow": 100,
        "angle_deg": angle_deg,
        "velocity_error": velocity_error,
        "coverage": 1.0,
        "precision": 0.5,
        "epe3d": 0.01,
    }
