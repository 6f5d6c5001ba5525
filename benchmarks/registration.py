"""Time per ICP of the samples' clusters, compiled against Open3D.

Run it from the project's folder: `.venv/bin/python -m benchmarks.registration`.
"""

import statistics
import time
from collections.abc import Callable, Iterator
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from estimator import Parameters, estimate, window_of_pair
from estimator.engine.registration import align
from estimator.icp import align as align_open3d
from recordings import open_recording, sample_paths

Points = NDArray[np.float64]

_SIZES = (20, 60, 120, 250, 500, 1000)
_REPETITIONS = 5


def sample_registrations() -> Iterator[tuple[Points, Points, float]]:
    """Every ICP of Algorithm 1 over the samples: source, target and reach."""
    parameters = Parameters()
    n, reach = parameters.n, parameters.max_correspondence_distance
    for path in sample_paths():
        with open_recording(path) as recording:
            for k in range(n, len(recording)):
                interval = float(recording.stamps[k] - recording.stamps[k - n])
                window = window_of_pair(recording.cloud(k - n), recording.cloud(k), interval)
                for cluster in estimate(window, parameters).clusters:
                    source, target = cluster.source, cluster.target
                    for done in cluster.rounds:
                        yield window.source.points[source], window.target.points[target], reach
                        source = np.setdiff1d(source, done.inlier_source)
                        target = np.setdiff1d(target, done.inlier_target)


def _microseconds(run: Callable[..., object], *arguments: object) -> float:
    start = time.perf_counter()
    run(*arguments)
    return 1e6 * (time.perf_counter() - start)


def main() -> None:
    """Print medians of both and their ratio for each class of sizes, and the ratio of the sums."""
    registrations = list(sample_registrations())
    answered = [align(*registration) is not None for registration in registrations]
    times: list[tuple[float, float]] = []
    for registration in registrations:
        compiled, open3d = [], []
        for _ in range(_REPETITIONS):
            compiled.append(_microseconds(align, *registration))
            open3d.append(_microseconds(align_open3d, *registration))
        times.append((statistics.median(compiled), statistics.median(open3d)))

    without = answered.count(False)
    print(f"{len(registrations)} ICPs of the samples, {without} left to Open3D; medians")
    sizes = [len(source) for source, _, _ in registrations]
    for least, most in pairwise(_SIZES):
        group = [
            both
            for size, is_answered, both in zip(sizes, answered, times, strict=True)
            if is_answered and least <= size < most
        ]
        if group:
            compiled, open3d = (statistics.median(column) for column in zip(*group, strict=True))
            print(
                f"{least:4}-{most:4} points, {len(group):3} ICPs: compiled {compiled:6.1f} us"
                f"  Open3D {open3d:6.1f} us  ratio {open3d / compiled:4.1f}"
            )
    alone = sum(open3d for _, open3d in times)
    both = sum(
        compiled + (0.0 if is_answered else open3d)
        for is_answered, (compiled, open3d) in zip(answered, times, strict=True)
    )
    print(f"all, those left to Open3D counted twice: ratio of the sums {alone / both:.1f}")


if __name__ == "__main__":
    main()
