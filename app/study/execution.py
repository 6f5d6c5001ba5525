"""Execution of a study's work on local cores or on a Dask cluster."""

import os
import shutil
import signal
import threading
import time
import warnings
from collections.abc import Generator, Iterator
from functools import partial
from pathlib import Path
from typing import Any

from app.analysis.method_files import load_method
from app.errors import InputError
from app.output.scratch import scratch_folder
from app.study.software import software_digest
from app.study.work import Outcome, Work, run_work

_PATIENCE = 10  # seconds, timeout of the connection to a scheduler
_LOOK_UP = 0.5  # seconds, after which a worker knows that the study was killed


def outcomes(
    works: list[Work], jobs: int, dask: str | None = None
) -> Generator[Outcome, None, None]:
    """Run units of work, and yield their outcomes in order of completion.

    Closing the iterator, or Ctrl-C, stops all running work.

    Args:
        works: units of work.
        jobs: processes on this machine.
        dask: address of a Dask scheduler to use instead, such as tcp://host:8786.

    Raises:
        InputError: the scheduler cannot be reached, or Dask is not installed.
    """
    if dask is not None:
        yield from _on_dask(works, dask)
        return
    # A common folder, since workers that are stopped cannot delete their own.
    with scratch_folder() as scratch:
        if jobs == 1 or len(works) < 2:
            for work in works:
                yield run_work(work, software_digest(work.method_files), scratch)
        else:
            yield from _on_cores(works, min(jobs, len(works)), scratch)


def _on_cores(works: list[Work], jobs: int, scratch: Path) -> Iterator[Outcome]:
    from joblib import Parallel, delayed, parallel_config

    # Else the process that tracks what workers use tells of it after the study was killed.
    os.environ["PYTHONWARNINGS"] = "ignore::UserWarning"
    files = _method_files(works)
    begin = partial(_begin_worker, files, os.getpid(), scratch)
    with parallel_config("loky", inner_max_num_threads=1, initializer=begin):
        done: Any = Parallel(n_jobs=jobs, return_as="generator_unordered")(
            delayed(run_work)(work, software_digest(files), scratch) for work in works
        )
    try:
        yield from done
    finally:
        with warnings.catch_warnings():
            # joblib warns of unfinished work, which is intended here.
            warnings.simplefilter("ignore", UserWarning)
            done.close()


def _begin_worker(method_files: tuple[str, ...], parent: int, scratch: Path) -> None:
    """Initialise a worker process: load methods, ignore Ctrl-C, and end when the study is killed.

    Methods must be registered before their parameters are unpickled. A terminal sends Ctrl-C
    to all processes; the parent handles it.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with, args=(parent, scratch), daemon=True).start()
    for text in method_files:
        load_method(text)


def _end_with(parent: int, scratch: Path) -> None:
    """End this process once its parent has ended, which otherwise would wait for work for ever."""
    while os.getppid() == parent:
        time.sleep(_LOOK_UP)
    shutil.rmtree(scratch, ignore_errors=True)
    os._exit(1)


def _method_files(works: list[Work]) -> tuple[str, ...]:
    return works[0].method_files if works else ()


def _method_loader(method_files: tuple[str, ...]) -> Any:  # noqa: ANN401 (of an optional package)
    """Dask plugin that loads methods in every worker, including those that join later."""
    from distributed import WorkerPlugin

    class MethodLoader(WorkerPlugin):
        name = "tofscope-methods"

        def setup(self, worker: object) -> None:
            del worker
            for text in method_files:
                load_method(text)

    return MethodLoader()


def _on_dask(works: list[Work], address: str) -> Iterator[Outcome]:
    try:
        from distributed import Client, as_completed
    except ImportError as error:
        raise InputError(
            "--dask needs the package distributed: install it with pip install 'tofscope[dask]'."
        ) from error
    try:
        client = Client(address, timeout=_PATIENCE)
    except (OSError, ValueError) as error:
        raise InputError(f"There is no Dask scheduler at {address}.") from error
    files = _method_files(works)
    with client:
        if files:
            client.register_plugin(_method_loader(files))
        futures = client.map(run_work, works, software=software_digest(files), pure=False)
        by_future = dict(zip(futures, works, strict=True))
        try:
            for future in as_completed(futures):
                error = future.exception()
                if error is None:
                    yield future.result()
                else:
                    source = by_future[future].source
                    yield Outcome(source, failure=f"{source.name}: the worker failed: {error}")
        finally:
            client.cancel(futures)
