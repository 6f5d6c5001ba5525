"""One run, one table: stages, pairs, recordings, sliders, opening and start, beside the naive way.

Run it from the project's folder on an idle machine: `make bench`. It prints the table and writes it
to benchmarks/results/last.json and .md, with the machine; `make bench-compare ARGS="A B"` compares
two of the JSON files.
"""

import json
import os
import platform
import resource
import statistics
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks import naive, slider
from benchmarks.registration import sample_registrations
from benchmarks.rows import HEADING, Row, against_naive, milliseconds
from estimator import Parameters, Stages, Window, estimate, window_of_pair
from estimator.engines import COMPILED, REFERENCE, warm_up
from recordings import open_recording, sample_paths

RESULTS = Path(__file__).parent / "results"
_THREADS = 2


def windows() -> list[list[Window]]:
    """The pairs of each sample."""
    found: list[list[Window]] = []
    n = Parameters().n
    for path in sample_paths():
        with open_recording(path) as recording:
            clouds = [recording.cloud(k) for k in range(len(recording))]
            stamps = recording.stamps
            found.append(
                [
                    window_of_pair(clouds[k - n], clouds[k], float(stamps[k] - stamps[k - n]))
                    for k in range(n, len(clouds))
                ]
            )
    return found


def fresh(window: Window) -> Window:
    """A window of which nothing is kept."""
    return replace(window, stages=Stages())


def clustering(pairs: list[Window]) -> Iterator[Row]:
    """HDBSCAN alone, at three sizes of cloud."""
    rng = np.random.default_rng(0)
    merged = [np.vstack([pair.target.points, pair.source.points]) for pair in pairs[::4]]
    sets = {
        "600": [cloud[rng.permutation(len(cloud))[:600]] for cloud in merged],
        "3,000": merged,
        "6,000": [np.vstack(two) for two in zip(merged[::2], merged[1::2], strict=False)],
    }
    for size, clouds in sets.items():
        ours = [partial(COMPILED.labels, cloud, 20, None, False) for cloud in clouds]
        theirs = [partial(naive.cluster, cloud) for cloud in clouds]
        yield against_naive(f"HDBSCAN, about {size} points", ours, theirs)


def flows(recordings: list[list[Window]]) -> Iterator[Row]:
    """A pair, and all pairs of a recording on one thread and on two."""
    default = Parameters()

    def whole(pairs: list[Window], pool: ThreadPoolExecutor) -> None:
        list(pool.map(lambda pair: estimate(fresh(pair), default), pairs))

    pairs = [pair for pairs in recordings for pair in pairs[::4]]
    yield against_naive(
        "a pair",
        [lambda pair=pair: estimate(fresh(pair), default) for pair in pairs],
        [partial(naive.flow, pair) for pair in pairs],
    )
    for threads in (1, _THREADS):
        with ThreadPoolExecutor(threads) as pool:
            yield against_naive(
                f"all pairs of a recording, {threads} thread{'s' * (threads > 1)}",
                [partial(whole, pairs, pool) for pairs in recordings],
                [lambda pairs=pairs: [naive.flow(pair) for pair in pairs] for pairs in recordings],
                times=2,
            )


def sliders(pairs: list[Window]) -> Iterator[Row]:
    """A parameter is changed for a pair on screen, and for all pairs of a recording."""
    default = Parameters()
    for name, values in (("gamma", (0.6, 0.8)), ("delta", (0.03, 0.05)), ("n_min", (40, 80))):
        kept = [fresh(pair) for pair in pairs]
        for pair in kept:
            for value in (getattr(default, name), *values):
                estimate(pair, replace(default, **{name: value}))
        changed: dict[str, Any] = {name: values[0]}
        parameters = replace(default, **changed)
        yield against_naive(
            f"{name}, a pair of which all is kept",
            [partial(estimate, pair, parameters) for pair in kept[::4]],
            [partial(naive.flow, pair) for pair in kept[::4]],
        )
        whole = statistics.median(
            milliseconds(lambda kept=kept, p=parameters: [estimate(pair, p) for pair in kept])
            for _ in range(5)
        )
        yield Row(f"{name}, {len(kept)} pairs of which all is kept", whole)
    yield Row("n, from the slider to the wire", statistics.median(slider.measure(plots=False)))


def files() -> Iterator[Row]:
    """A sample is opened, and its frames are read in any order."""
    path = sample_paths()[0]
    opening = [milliseconds(lambda: open_recording(path).close()) for _ in range(7)]
    yield Row("opening a sample", statistics.median(opening))
    with open_recording(path) as recording:
        order = np.random.default_rng(0).permutation(len(recording))
        seeks = [milliseconds(partial(recording.cloud, int(k))) for k in order]
    yield Row("seeking in a sample, a frame not read before", statistics.median(seeks))


def start() -> Iterator[Row]:
    """The command line's help, and the memory of this run."""
    command = [sys.executable, "-m", "app", "--help"]
    run = partial(subprocess.run, command, check=True, stdout=subprocess.DEVNULL)
    yield Row("tofscope --help", statistics.median(milliseconds(run) for _ in range(7)))
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    yield Row("peak memory of this run", peak, "MB")


def machine() -> str:
    """Processor, system, Python and load."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.exists() else []
    models = [line.split(":")[1].strip() for line in lines if line.startswith("model name")]
    return (
        f"{os.cpu_count()} x {models[0] if models else platform.machine()}, {platform.system()}, "
        f"Python {platform.python_version()}, load {os.getloadavg()[0]:.1f} at the start"
    )


def rows() -> Iterator[Row]:
    """All rows, in order."""
    warm_up(COMPILED)
    recordings = windows()
    pairs = [pair for pairs in recordings for pair in pairs]
    yield from clustering(pairs)
    registrations = list(sample_registrations())
    yield against_naive(
        "an ICP",
        [partial(COMPILED.align, *each) for each in registrations],
        [partial(REFERENCE.align, *each) for each in registrations],
    )
    yield from flows(recordings)
    yield from sliders(recordings[0])
    yield from files()
    yield from start()


def main() -> None:
    """Measure, print and keep the table."""
    on, table = machine(), []
    print("\n".join((on, "", *HEADING)), flush=True)
    for row in rows():
        table.append(row)
        print(row.line(), flush=True)
    RESULTS.mkdir(exist_ok=True)
    kept = {"machine": on, "rows": [asdict(row) for row in table]}
    (RESULTS / "last.json").write_text(json.dumps(kept, indent=2) + "\n")
    lines = ["# The last `make bench`", "", f"{on}.", "", *HEADING, *(row.line() for row in table)]
    (RESULTS / "last.md").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
