"""HDBSCAN alone, beside scikit-learn's."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from benchmarks import naive
from benchmarks.inputs import sample_windows
from benchmarks.rows import Row, against_naive
from estimator.engines import COMPILED


def measure() -> Iterator[Row]:
    """A row for each of three sizes: part of a merged pair of the samples, one, and two."""
    rng = np.random.default_rng(0)
    merged = [np.vstack([pair.target.points, pair.source.points]) for pair in sample_windows()]
    sets = {
        "600": [cloud[rng.permutation(len(cloud))[:600]] for cloud in merged],
        "3,000": merged,
        "6,000": [np.vstack(two) for two in zip(merged[::2], merged[1::2], strict=False)],
    }
    for size, clouds in sets.items():
        ours = [partial(COMPILED.labels, cloud, 20, None, False) for cloud in clouds]
        theirs = [partial(naive.cluster, cloud) for cloud in clouds]
        yield against_naive(f"HDBSCAN, about {size} points", ours, theirs)
