"""All pairs of a recording, on one thread and on two, nothing kept."""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

from benchmarks import naive
from benchmarks.inputs import fresh, whole_windows
from benchmarks.rows import Row, against_naive
from estimator import Parameters, estimate


def measure() -> Iterator[Row]:
    """A row for each number of threads; the naive pipeline has one in both."""
    pairs, default = whole_windows(), Parameters()
    for threads in (1, 2):
        with ThreadPoolExecutor(threads) as pool:
            yield against_naive(
                f"{len(pairs)} pairs of a recording, {threads} thread{'s' * (threads > 1)}",
                [lambda pool=pool: list(pool.map(lambda p: estimate(fresh(p), default), pairs))],
                [lambda: [naive.flow(pair) for pair in pairs]],
                times=5,
            )
