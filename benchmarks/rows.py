"""Rows of the benchmark's table."""

import statistics
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """One measured thing.

    Attributes:
        name: what was done.
        value: median, in `unit`.
        unit: of both values.
        naive: the naive pipeline's in the same run, None where it has nothing of the kind.
    """

    name: str
    value: float
    unit: str = "ms"
    naive: float | None = None

    @property
    def ratio(self) -> float | None:
        """How many times as fast as the naive pipeline."""
        return None if self.naive is None else self.naive / self.value

    def line(self) -> str:
        """The row as a line of a Markdown table."""
        naive = "" if self.naive is None else f"{self.naive:.2f}"
        ratio = "" if self.ratio is None else f"{self.ratio:.1f}"
        return f"| {self.name} | {self.value:.2f} {self.unit} | {naive} | {ratio} |"


HEADING = ("| what | median | naive | ratio |", "|---|---:|---:|---:|")


def milliseconds(action: Callable[[], object]) -> float:
    """Time of one call."""
    begin = time.perf_counter()
    action()
    return 1e3 * (time.perf_counter() - begin)


def against_naive(
    name: str,
    ours: Sequence[Callable[[], object]],
    naive: Sequence[Callable[[], object]],
    times: int = 3,
) -> Row:
    """Medians of two ways to do the same with each input, in turns; of several times, too."""
    pairs: list[tuple[float, float]] = []
    for our, their in zip(ours, naive, strict=True):
        runs = [(milliseconds(our), milliseconds(their)) for _ in range(times)]
        pairs.append(_medians(runs))
    mine, other = _medians(pairs)
    return Row(name, mine, naive=other)


def _medians(both: Sequence[tuple[float, float]]) -> tuple[float, float]:
    mine, other = zip(*both, strict=True)
    return statistics.median(mine), statistics.median(other)
