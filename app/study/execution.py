"""Units of work on all cores of this machine, or on a Dask cluster."""

import signal
import tempfile
import warnings
from collections.abc import Generator, Iterator
from functools import partial
from pathlib import Path
from typing import Any

from app.analysis.method_files import load_method
from app.errors import InputError
from app.study.software import software_digest
from app.study.work import Outcome, Work, run_work

_PATIENCE = 10  # seconds to wait for a scheduler


def outcomes(
    works: list[Work], jobs: int, dask: str | None = None
) -> Generator[Outcome, None, None]:
    """Do the work and give what comes of it, whatever is finished first.

    Closing the iterator, or Ctrl-C, stops all that is under way.

    Args:
        works: the units.
        jobs: processes on this machine.
        dask: address of a Dask scheduler that does the work instead, such as tcp://host:8786.

    Raises:
        InputError: there is no scheduler, or Dask is not installed.
    """
    if dask is not None:
        yield from _on_dask(works, dask)
        return
    # A folder of ours: workers that are stopped cannot clear away theirs.
    with tempfile.TemporaryDirectory(prefix="tofscope-study-") as scratch:
        if jobs == 1 or len(works) < 2:
            for work in works:
                yield run_work(work, software_digest(work.method_files), Path(scratch))
        else:
            yield from _on_cores(works, min(jobs, len(works)), Path(scratch))


def _on_cores(works: list[Work], jobs: int, scratch: Path) -> Iterator[Outcome]:
    from joblib import Parallel, delayed, parallel_config

    files = _method_files(works)
    begin = partial(_begin_worker, files)
    with parallel_config("loky", inner_max_num_threads=1, initializer=begin):
        done: Any = Parallel(n_jobs=jobs, return_as="generator_unordered")(
            delayed(run_work)(work, software_digest(files), scratch) for work in works
        )
    try:
        yield from done
    finally:
        with warnings.catch_warnings():
            # That not all was done is what whoever closes this wants, and says.
            warnings.simplefilter("ignore", UserWarning)
            done.close()


def _begin_worker(method_files: tuple[str, ...]) -> None:
    """Load methods before work with their parameters arrives, and leave Ctrl-C to the parent.

    A terminal sends it to every process, and only the one that started the others answers.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for text in method_files:
        load_method(text)


def _method_files(works: list[Work]) -> tuple[str, ...]:
    return works[0].method_files if works else ()


def _method_loader(method_files: tuple[str, ...]) -> Any:  # noqa: ANN401 (of an optional package)
    """Plugin of Dask that loads methods in every worker, those that join later too."""
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
