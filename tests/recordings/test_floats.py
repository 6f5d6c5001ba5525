"""Floats of messages."""

import warnings

import numpy as np

from recordings.floats import as_doubles


def test_a_signalling_nan_is_one_like_any_other():
    values = np.array([0x7F800001, 0x3F800000], dtype="<u4").view("<f4")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = as_doubles(values)
    np.testing.assert_array_equal(found, [np.nan, 1.0])
