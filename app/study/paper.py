"""The paper's published numbers, and its names of experiments."""

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from estimator import find_method

LABELS = {
    "towards": "y-axis",
    "sideways": "x-axis",
    "robot_moving": "Robot with ToF moving",
}
"""{scenario: its name in the paper's tables}."""
FRAME = 1 / 15
"""Frame period, seconds."""


@dataclass(frozen=True)
class PaperRow:
    """A row of the paper's tables: means and standard deviations over its trials.

    Attributes:
        angle_mean: degrees.
        angle_std: degrees.
        velocity_mean: m/s.
        velocity_std: m/s.
    """

    angle_mean: float
    angle_std: float
    velocity_mean: float
    velocity_std: float


@dataclass(frozen=True)
class PaperNumbers:
    """Tables I and II of the paper.

    Attributes:
        source: citation.
        rows: {(scenario, method, m/s): its row}.
    """

    source: str
    rows: dict[tuple[str, str, float], PaperRow]


@cache
def paper_numbers() -> PaperNumbers:
    """Load the paper's numbers from the data file."""
    content = tomllib.loads(files("app.study").joinpath("paper_numbers.toml").read_text("utf-8"))
    rows = {
        (e["scenario"], e["method"], speed): PaperRow(
            **{key: e[key][i] for key in PaperRow.__dataclass_fields__}
        )
        for e in content["experiment"]
        for i, speed in enumerate(e["speed"])
    }
    return PaperNumbers(content["source"], rows)


def method_label(method: str) -> str:
    """Name of a method in tables and figures."""
    return find_method(method).label


def experiment_label(scenario: str, method: str) -> str:
    """Name of an experiment in tables."""
    return f"{LABELS.get(scenario, scenario)} ({method_label(method)})"
