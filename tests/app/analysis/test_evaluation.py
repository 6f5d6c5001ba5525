"""Errors over whole recordings: real flights against the document that describes them."""

from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

from app.analysis.evaluation import EvaluationCase, evaluate_all
from app.analysis.parameter_files import load
from estimator import Metrics, Parameters
from recordings import open_recording
from tests.conftest import REPOSITORY

METHODS = ("paper", "baseline")
FLIGHTS = ("a0", "a1", "a2", "a3")


@cache
def document() -> str:
    return (REPOSITORY / "docs" / "real_flights.md").read_text(encoding="utf-8")


@cache
def documented() -> dict[tuple[str, str], dict[str, float]]:
    """{(flight, method): its line} of the document's table."""
    lines = document().splitlines()
    start = next(i for i, line in enumerate(lines) if line.startswith("| flight | method |"))
    titles = [cell.strip() for cell in lines[start].strip("|").split("|")]
    found = {}
    for line in lines[start + 2 : start + 2 + len(FLIGHTS) * len(METHODS)]:
        flight, method, *values = (cell.strip() for cell in line.strip("|").split("|"))
        found[flight[:2], method] = dict(zip(titles[2:], map(float, values), strict=True))
    return found


def evaluated(path: Path, fixed_frame: str, cases: list[Parameters]) -> list[Metrics]:
    with open_recording(path, fixed_frame, truth_frame="surface") as recording:
        evaluations = evaluate_all(recording, [EvaluationCase(case) for case in cases])
    metrics = [evaluation.metrics for evaluation in evaluations if evaluation.metrics]
    assert len(metrics) == len(cases)
    return metrics


@pytest.mark.parametrize("flight", FLIGHTS)
def test_a_real_flight_gives_what_its_document_says(shared_data: Path, flight: str):
    path = shared_data / "matrix_tof_flights" / f"approach_{flight}.mcap"
    common = load(REPOSITORY / "docs" / "real_flights.json")
    cases = [replace(common, method=method) for method in METHODS]
    silent = replace(common, delta=10.0)
    *in_sensor, silence = evaluated(path, "tof_front_optical_frame", [*cases, silent])
    in_world = evaluated(path, "world", cases)
    assert f"{silence.epe3d:.4f}" in document()
    for method, moving, still in zip(METHODS, in_sensor, in_world, strict=True):
        said = documented()[flight, method]
        assert moving.pairs == said["pairs"]
        assert still.pairs == 0
        # Ties in HDBSCAN fall in another way on other processors.
        assert moving.angle_deg == pytest.approx(said["angle deg"], abs=2)
        assert moving.velocity_error == pytest.approx(said["velocity error m/s"], abs=0.02)
        assert moving.coverage == pytest.approx(said["coverage"], abs=0.02)
        assert moving.epe3d == pytest.approx(said["EPE3D m"], abs=0.003)
        assert moving.epe3d / silence.epe3d == pytest.approx(said["motion left"], abs=0.03)
        assert still.false_flow == pytest.approx(said["false flow"], abs=0.02)
