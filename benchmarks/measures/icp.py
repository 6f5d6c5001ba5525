"""ICP alone, beside Open3D's."""

from collections.abc import Iterator
from functools import partial

from benchmarks.registration import sample_registrations
from benchmarks.rows import Row, against_naive
from estimator.engines import COMPILED, REFERENCE


def measure() -> Iterator[Row]:
    """A row over every registration of the samples."""
    registrations = list(sample_registrations())
    yield against_naive(
        "an ICP",
        [partial(COMPILED.align, *each) for each in registrations],
        [partial(REFERENCE.align, *each) for each in registrations],
    )
