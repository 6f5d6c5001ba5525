"""A function applied to many things by processes on this machine."""

import os
import shutil
import signal
import threading
import time
import warnings
from collections.abc import Callable, Generator, Iterable, Sequence
from contextlib import closing
from functools import partial
from pathlib import Path
from typing import Any

from app.analysis.method_files import load_method
from app.execution.lost import Lost

_LOOK_UP = 0.5  # seconds, after which a worker knows that the command was killed
_KILLED = Lost("the process that worked on it was ended from outside, perhaps for want of memory")


def on_cores(
    function: Callable[[Any], Any],
    items: Sequence[Any],
    jobs: int,
    method_files: tuple[str, ...],
    scratch: Path | None,
) -> Generator[tuple[int, Any], None, None]:
    """Yield (index, result, or Lost where its process was killed) in order of completion.

    Args:
        function: of one item.
        items: any number.
        jobs: processes, 2 or more.
        method_files: FILE.py:NAME of methods that the processes load.
        scratch: folder that the processes remove if the command is killed.
    """
    from joblib.externals.loky.process_executor import TerminatedWorkerError

    # Else the process that tracks what workers use tells of it after the command was killed.
    os.environ["PYTHONWARNINGS"] = "ignore::UserWarning"
    begin = partial(_begin_worker, method_files, os.getpid(), scratch)
    left = dict.fromkeys(range(len(items)))
    try:
        with closing(_computed(function, items, left, jobs, begin)) as done:
            for index, result in done:
                del left[index]
                yield index, result
    except TerminatedWorkerError:
        # It takes the others with it, and does not say what it was at: each is tried alone.
        for index in left:
            try:
                yield from _computed(function, items, [index], jobs, begin)
            except TerminatedWorkerError:
                yield index, _KILLED


def _computed(
    function: Callable[[Any], Any],
    items: Sequence[Any],
    indices: Iterable[int],
    jobs: int,
    begin: Callable[[], None],
) -> Generator[tuple[int, Any], None, None]:
    from joblib import Parallel, delayed, parallel_config

    with parallel_config("loky", inner_max_num_threads=1, initializer=begin):
        done: Any = Parallel(n_jobs=jobs, return_as="generator_unordered")(
            delayed(_numbered)(function, index, items[index]) for index in list(indices)
        )
    try:
        for each in done:  # noqa: UP028 (`yield from` closes it before the clause below)
            yield each
    finally:
        with warnings.catch_warnings():
            # joblib warns of unfinished work, which is intended here.
            warnings.simplefilter("ignore", UserWarning)
            done.close()


def _numbered(function: Callable[[Any], Any], index: int, item: Any) -> tuple[int, Any]:  # noqa: ANN401
    return index, function(item)


def _begin_worker(method_files: tuple[str, ...], parent: int, scratch: Path | None) -> None:
    """Initialise a worker process: load methods, ignore Ctrl-C, and end when the command is killed.

    Methods must be registered before their parameters are unpickled. A terminal sends Ctrl-C
    to all processes; the parent handles it.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with, args=(parent, scratch), daemon=True).start()
    for text in method_files:
        load_method(text)


def _end_with(parent: int, scratch: Path | None) -> None:
    """End this process once its parent has ended, which otherwise would wait for work for ever."""
    while os.getppid() == parent:
        time.sleep(_LOOK_UP)
    if scratch is not None:
        shutil.rmtree(scratch, ignore_errors=True)
    os._exit(1)
