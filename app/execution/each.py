"""Results of a function for each of many things, wherever they are computed."""

from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, Generic, TypeVar

from app.execution.cluster import on_cluster
from app.execution.cores import on_cores
from app.execution.lost import Lost
from estimator import ENGINES, current_engine, use_engine

_Item = TypeVar("_Item")
_Result = TypeVar("_Result")


@dataclass(frozen=True)
class Place:
    """Where functions run.

    Attributes:
        jobs: processes on this machine; with one, or for a single thing, it is this process.
        dask: address of a Dask scheduler to use instead, such as tcp://host:8786.
        method_files: FILE.py:NAME of the methods from files, which every worker loads.
        scratch: folder that the last process removes if this one is killed.
    """

    jobs: int
    dask: str | None = None
    method_files: tuple[str, ...] = ()
    scratch: Path | None = None


@dataclass(frozen=True)
class Call(Generic[_Item, _Result]):
    """What is computed.

    Attributes:
        function: of one thing; known to the workers by its name, and raises nothing.
        failed: the result for a thing whose worker ended, from a reason without a full stop.
    """

    function: Callable[[_Item], _Result]
    failed: Callable[[_Item, str], _Result]


def results(
    call: Call[_Item, _Result], items: Sequence[_Item], place: Place
) -> Generator[tuple[int, _Result], None, None]:
    """Compute a result for each item, and yield (its index, the result) in order of completion.

    Closing the iterator, or Ctrl-C, stops all that is running.

    Raises:
        InputError: the scheduler cannot be reached, or Dask is not installed.
    """
    done: Generator[tuple[int, Any], None, None]
    elsewhere = partial(_with_engine, engine=current_engine().name, function=call.function)
    if place.dask is not None:
        done = on_cluster(elsewhere, items, place.dask, place.method_files)
    elif place.jobs == 1 or len(items) < 2:
        for index, item in enumerate(items):
            yield index, call.function(item)
        return
    else:
        jobs = min(place.jobs, len(items))
        done = on_cores(elsewhere, items, jobs, place.method_files, place.scratch)
    try:
        for index, found in done:
            lost = isinstance(found, Lost)
            yield index, call.failed(items[index], found.reason) if lost else found
    finally:
        done.close()


def _with_engine(item: _Item, engine: str, function: Callable[[_Item], _Result]) -> _Result:
    """Apply a function in a worker, whose estimates are made by the command's engine."""
    use_engine(ENGINES[engine])
    return function(item)
