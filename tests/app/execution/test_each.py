import os
from typing import Any

import pytest

from app.execution.each import Call, Place, results
from tests.app.execution.calls import failed, squared

CALL: Call[int, Any] = Call(squared, failed)


@pytest.mark.parametrize("jobs", [1, 2, 7])
def test_every_item_has_its_result_whatever_the_number_of_jobs(jobs: int):
    numbers = [5, 3, 3, 8]
    assert dict(results(CALL, numbers, Place(jobs))) == {0: 25, 1: 9, 2: 9, 3: 64}


def test_of_nothing_there_is_no_result():
    assert not list(results(CALL, [], Place(2)))


def test_a_single_item_needs_no_other_process():
    ours: Call[int, int] = Call(lambda _: os.getpid(), failed)  # type: ignore[arg-type]
    assert list(results(ours, [1], Place(8))) == [(0, os.getpid())]


def test_a_killed_worker_costs_its_own_item_alone():
    done = dict(results(CALL, [1, 2, 13, 3, 4], Place(2)))
    assert "ended from outside" in done.pop(2)
    assert done == {0: 1, 1: 4, 3: 9, 4: 16}


def test_after_the_iterator_is_closed_others_can_run():
    running = results(CALL, list(range(12)), Place(2))
    next(running)
    running.close()
    assert dict(results(CALL, [6, 7], Place(2))) == {0: 36, 1: 49}
