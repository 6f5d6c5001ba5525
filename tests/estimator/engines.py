"""Engines to compare, and to count the work of."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

from estimator import Engine, current_engine, use_engine
from estimator.engine.hdbscan import hdbscan
from estimator.engines import COMPILED, REFERENCE


def _labels(points, min_cluster_size, min_samples, allow_single_cluster):
    single = allow_single_cluster
    return hdbscan(
        points, min_cluster_size, min_samples, allow_single_cluster=single, order="quicksort"
    )[0]


AS_SCIKIT_LEARN = Engine("compiled, edges sorted as scikit-learn does", _labels, COMPILED.align)
EXACT = (REFERENCE, AS_SCIKIT_LEARN)
"""Engines whose labels are scikit-learn's, ties included."""


@contextmanager
def using(engine: Engine) -> Iterator[None]:
    """Estimate with an engine."""
    before = current_engine()
    use_engine(engine)
    try:
        yield
    finally:
        use_engine(before)


class Counting:
    """Calls of an engine's two steps while it is used."""

    def __init__(self) -> None:
        self.clusterings: list[Any] = []
        self.icps: list[Any] = []

    def engine(self) -> Engine:
        def labels(*arguments):
            self.clusterings.append(arguments)
            return COMPILED.labels(*arguments)

        def align(*arguments):
            self.icps.append(arguments)
            return COMPILED.align(*arguments)

        return replace(COMPILED, labels=labels, align=align)
