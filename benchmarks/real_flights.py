"""Search for parameters that suit real flights at a panel, on given recordings.

Run it from the project's folder: `.venv/bin/python -m benchmarks.real_flights FILE ...`;
`docs/real_flights.md` has purpose and results.
"""

import argparse
from contextlib import ExitStack
from dataclasses import replace
from itertools import count, product
from pathlib import Path
from typing import Any

from app.analysis.evaluation import EvaluationCase, evaluate_all
from app.analysis.parameter_files import to_text
from estimator import Metrics, Parameters
from recordings import Recording, open_recording

SENSOR, WORLD, PANEL = "tof_front_optical_frame", "world", "surface"
LIMIT = 0.05
"""Share of points that may be flagged in the world's frame, where nothing moves."""

START = Parameters(
    n=3,
    n_min=10,
    min_cluster_size=10,
    allow_single_cluster=True,
    max_correspondence_distance=0.25,
    delta=0.06,
)
GRID: dict[str, tuple[Any, ...]] = {
    "n": (2, 3, 4, 5, 6, 8),
    "delta": (0.02, 0.04, 0.06, 0.08, 0.10, 0.12),
    "n_min": (3, 5, 8, 10, 15),
    "min_cluster_size": (3, 5, 8, 10, 15),
    "allow_single_cluster": (False, True),
    "max_correspondence_distance": (0.15, 0.20, 0.25, 0.30, 0.40),
    "gamma": (0.5, 0.6, 0.7, 0.8, 0.9),
}
STEPS = (
    ("n", "delta"),  # a longer interval needs a larger threshold
    ("n_min", "min_cluster_size"),
    ("allow_single_cluster", "max_correspondence_distance"),
    ("gamma",),
)


class Flights:
    """The recordings, opened in the sensor's frame and in the world's."""

    def __init__(self, paths: list[Path], stack: ExitStack) -> None:
        self._pairs = [
            tuple(stack.enter_context(open_recording(p, f, PANEL)) for f in (SENSOR, WORLD))
            for p in paths
        ]
        self._known: dict[Parameters, tuple[float, float]] = {}
        self._zero_flow_epe: dict[tuple[Path, int], float] = {}

    def score(self, parameters: Parameters) -> tuple[float, float]:
        """Motion left, mean over the flights, and the largest false flow of them."""
        if parameters not in self._known:
            left = [self._motion_left(sensor, parameters) for sensor, _ in self._pairs]
            false = [_metrics(world, parameters).false_flow for _, world in self._pairs]
            self._known[parameters] = sum(left) / len(left), max(false)
        return self._known[parameters]

    def _motion_left(self, recording: Recording, parameters: Parameters) -> float:
        """Motion left: EPE3D relative to that of zero flow, 0 is perfect."""
        key = recording.path, parameters.n
        if key not in self._zero_flow_epe:
            nothing = replace(parameters, method="paper", delta=10.0)
            self._zero_flow_epe[key] = _metrics(recording, nothing).epe3d
        return _metrics(recording, parameters).epe3d / self._zero_flow_epe[key]


def search(flights: Flights) -> Parameters:
    """Search each group of parameters exhaustively, in turns, until a turn changes nothing."""
    best = START
    print(_row("start", flights.score(best), best), flush=True)
    for turn in count(1):
        before = best
        for names in STEPS:
            sets = product(*(GRID[name] for name in names))
            options = [best, *(replace(best, **dict(zip(names, v, strict=True))) for v in sets)]
            best = min(options, key=lambda parameters: _rank(flights.score(parameters)))
            print(_row(f"{turn} {', '.join(names)}", flights.score(best), best), flush=True)
        if best == before:
            return best
    raise AssertionError


def _rank(score: tuple[float, float]) -> tuple[float, float]:
    motion_left, false = score
    return max(false - LIMIT, 0.0), motion_left


def _metrics(recording: Recording, parameters: Parameters) -> Metrics:
    # In the sensor's frame almost every pair counts, in the world's none does.
    case = EvaluationCase(parameters, resting=recording.fixed_frame == WORLD)
    metrics = evaluate_all(recording, [case])[0].metrics
    if metrics is None:
        raise ValueError(f"{recording.path} has no {PANEL}.")
    return metrics


def _row(label: str, score: tuple[float, float], p: Parameters) -> str:
    values = " ".join(f"{getattr(p, name)!s:>5}" for name in GRID)
    return f"{label:52} left {score[0]:.4f}  false {score[1]:.4f}  {values}"


def main() -> None:
    """Search, and print the best parameters as a parameter file."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE", help="a recording")
    with ExitStack() as stack:
        found = search(Flights(parser.parse_args().files, stack))
    print(to_text(found), end="")


if __name__ == "__main__":
    main()
