"""Fixtures of the estimator's tests."""

import pytest

from tests.estimator.engines import Counting, using


@pytest.fixture
def counting():
    """Counts clusterings and ICPs."""
    counting = Counting()
    with using(counting.engine()):
        yield counting
