"""The table of range maxima against the largest of each stretch."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from estimator.engine.range_maximum import maximum_between, range_maxima


@given(values=st.lists(st.floats(allow_nan=False), min_size=2, max_size=40))
def test_every_stretch(values):
    table = range_maxima(np.array(values))
    for first in range(len(values)):
        for last in range(first + 1, len(values)):
            assert maximum_between(table, first, last) == max(values[first + 1 : last + 1])


@pytest.mark.parametrize("size", [127, 128, 129])
def test_stretches_about_a_power_of_two(size):
    values = np.random.default_rng(size).normal(size=size)
    table = range_maxima(values)
    for first in range(size - 1):
        assert maximum_between(table, first, size - 1) == values[first + 1 :].max()
