"""Time per slider step with cached stages of Algorithm 1, against computing all of them again.

Run it from the project's folder: `.venv/bin/python -m benchmarks.stages`.
"""

import statistics
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial

from estimator import Parameters, Window, window_of_pair
from estimator import estimate as estimate_window
from estimator.stages import Stages
from recordings import open_recording, sample_paths

_SWEEPS: dict[str, list[dict[str, float | int | str]]] = {
    "gamma": [{"gamma": 0.05 * step} for step in range(1, 20)],
    "delta": [{"delta": 0.005 * step} for step in range(1, 20)],
    "n_min": [{"n_min": 10 * step} for step in range(1, 20)],
    "method": [{"method": name} for name in ("baseline", "paper") * 5],
    "min_cluster_size": [{"min_cluster_size": size} for size in range(15, 25)],
}
"""{slider: the values it is moved over}."""

_STEP = 4  # pairs


def _pairs() -> Iterator[Window]:
    n = Parameters().n
    for path in sample_paths():
        with open_recording(path) as recording:
            for k in range(n, len(recording), _STEP):
                interval = float(recording.stamps[k] - recording.stamps[k - n])
                yield window_of_pair(recording.cloud(k - n), recording.cloud(k), interval)


def _forgotten(pair: Window) -> Window:
    return replace(pair, stages=Stages())


def _milliseconds(estimate: Callable[[], object]) -> float:
    start = time.perf_counter()
    estimate()
    return 1e3 * (time.perf_counter() - start)


def main() -> None:
    """Print medians per estimate with and without memory, and their ratio, for each slider."""
    pairs, default = list(_pairs()), Parameters()
    print(f"{len(pairs)} pairs of the samples; medians and sums over a slider's way")
    for slider, values in _SWEEPS.items():
        again: list[float] = []
        kept: list[float] = []
        for pair in pairs:
            remembering = _forgotten(pair)
            estimate_window(remembering, default)  # what is on the screen before the slider moves
            for value in values:
                parameters = replace(default, **value)  # pyright: ignore[reportArgumentType]
                fresh = _forgotten(pair)
                again.append(_milliseconds(partial(estimate_window, fresh, parameters)))
                kept.append(_milliseconds(partial(estimate_window, remembering, parameters)))
        medians, sums = [(f(again), f(kept)) for f in (statistics.median, sum)]
        print(
            f"{slider:17} again {medians[0]:6.2f} ms  remembered {medians[1]:6.2f} ms"
            f"  ratio {medians[0] / medians[1]:5.1f}  of the sums {sums[0] / sums[1]:5.1f}"
        )


if __name__ == "__main__":
    main()
