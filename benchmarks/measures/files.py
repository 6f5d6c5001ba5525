"""A sample is opened, and its frames are read in any order."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from benchmarks import naive
from benchmarks.rows import Row, against_naive
from recordings import open_recording, sample_paths

_OPENINGS = 7


def measure() -> Iterator[Row]:
    """Opening, and a cloud that was not read before."""
    path = sample_paths()[0]
    opening = [lambda: open_recording(path).close()] * _OPENINGS
    yield against_naive(
        "opening a sample (naive: a pair alone)", opening, naive.pairs_alone(_OPENINGS), times=1
    )
    with open_recording(path) as recording:
        order = np.random.default_rng(0).permutation(len(recording))
        yield against_naive(
            "seeking, a frame not read before (naive: a pair alone)",
            [partial(recording.cloud, int(k)) for k in order],
            naive.pairs_alone(len(order)),
            times=1,  # the second time it has been read
        )
