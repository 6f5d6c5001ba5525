"""A parameter takes a value it has not had, and everything else of the default estimate is kept."""

import statistics
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from benchmarks import naive, slider
from benchmarks.inputs import fresh, sample_windows, windows_of
from benchmarks.rows import Row, against_naive, milliseconds
from estimator import Parameters, Window, estimate
from recordings import sample_paths

_N_MIN, _N = 40, 6
_TIMES = 3


def measure() -> Iterator[Row]:
    """N_min and n of a pair, and n from the slider to the wire."""
    pairs = sample_windows()
    alone = [[pair] for pair in pairs]
    yield _changed("n_min, a pair, the rest kept", alone, {"n_min": _N_MIN})
    # Another n pairs other clouds: of an estimate with the default n nothing can be used again.
    others = [pair for path in sample_paths() for pair in windows_of(path, _N)[::4]]
    yield against_naive(
        "n, a pair, its clouds kept",
        [lambda pair=pair: estimate(fresh(pair), replace(Parameters(), n=_N)) for pair in others],
        [partial(naive.flow, pair) for pair in others],
    )
    to_the_wire = statistics.median(slider.measure(plots=False))
    one_pair = statistics.median(milliseconds(partial(naive.flow, pair)) for pair in pairs)
    yield Row("n, slider to the wire (naive: a pair alone)", to_the_wire, naive=one_pair)


def _changed(name: str, groups: Sequence[Sequence[Window]], change: dict[str, Any]) -> Row:
    """Each group estimated after a change, in turns with the naive pipeline.

    A value that was estimated before would be found among what is kept, so that each time begins
    with windows that know the default estimate alone.
    """
    parameters = replace(Parameters(), **change)
    ours, theirs = [], []
    for group in groups:
        for _ in range(_TIMES):
            kept = [fresh(pair) for pair in group]
            for pair in kept:
                estimate(pair, Parameters())
            ours.append(milliseconds(lambda kept=kept: [estimate(p, parameters) for p in kept]))
            theirs.append(
                milliseconds(lambda group=group: [naive.flow(p, **change) for p in group])
            )
    return Row(name, statistics.median(ours), naive=statistics.median(theirs))
