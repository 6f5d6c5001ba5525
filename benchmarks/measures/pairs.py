"""One pair from its clouds to its flow, nothing kept."""

from collections.abc import Iterator
from functools import partial

from benchmarks import naive
from benchmarks.inputs import fresh, sample_windows, wide_windows
from benchmarks.rows import Row, against_naive
from estimator import Parameters, Window, estimate


def measure() -> Iterator[Row]:
    """A row for the samples' 24 sensors, and one for 100."""
    for sensors, pairs in ((24, sample_windows()), (100, wide_windows())):
        yield against_naive(
            f"a pair, {sensors} sensors",
            [partial(_estimated, pair) for pair in pairs],
            [partial(naive.flow, pair) for pair in pairs],
        )


def _estimated(pair: Window) -> None:
    estimate(fresh(pair), Parameters())
