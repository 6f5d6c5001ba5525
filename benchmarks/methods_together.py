"""Estimating time of a study's methods on one recording: each on its own, and all together.

Together a pair is clustered once, and ICP rounds that methods share are run once. Run it from the
project's folder: `.venv/bin/python -m benchmarks.methods_together [METHOD ...]`.
"""

import argparse

from threadpoolctl import threadpool_limits

from app.analysis.evaluation import EvaluationCase, evaluate_all
from estimator import Parameters
from recordings import open_recording, sample_paths


def main() -> None:
    """Print seconds of one core for each sample and their ratio, measured in this run."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("methods", nargs="*", metavar="METHOD", help="default: paper baseline")
    methods = parser.parse_args().methods or ["paper", "baseline"]
    cases = [EvaluationCase(Parameters(method=method)) for method in methods]
    print(f"{'recording':24}  {'apart':>8}  {'together':>8}  ratio")
    sums = [0.0, 0.0]
    with threadpool_limits(1):
        for path in sample_paths():
            with open_recording(path) as recording:
                evaluate_all(recording, cases[:1])  # frames are decoded, packages loaded
                apart = [evaluate_all(recording, [case])[0] for case in cases]
                together = evaluate_all(recording, cases)
            # repr, since nan is not equal to itself.
            assert repr([e.metrics for e in apart]) == repr([e.metrics for e in together])
            seconds = [sum(e.seconds for e in found) for found in (apart, together)]
            sums = [total + s for total, s in zip(sums, seconds, strict=True)]
            _print(path.stem, *seconds)
    _print("all", *sums)


def _print(name: str, apart: float, together: float) -> None:
    print(f"{name:24}  {apart:6.2f} s  {together:6.2f} s  {together / apart:.2f}")


if __name__ == "__main__":
    main()
