"""Units of work on all cores of this machine, or on a Dask cluster."""

import signal
import tempfile
import warnings
from collections.abc import Generator, Iterator
from pathlib import Path
from typing import Any

from app.errors import InputError
from app.study.software import software_digest
from app.study.work import Outcome, Work, do

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
                yield do(work, software_digest(), Path(scratch))
        else:
            yield from _on_cores(works, min(jobs, len(works)), Path(scratch))


def _on_cores(works: list[Work], jobs: int, scratch: Path) -> Iterator[Outcome]:
    from joblib import Parallel, delayed, parallel_config

    with parallel_config("loky", inner_max_num_threads=1, initializer=_leave_ctrl_c_to_us):
        done: Any = Parallel(n_jobs=jobs, return_as="generator_unordered")(
            delayed(do)(work, software_digest(), scratch) for work in works
        )
    try:
        yield from done
    finally:
        with warnings.catch_warnings():
            # That not all was done is what whoever closes this wants, and says.
            warnings.simplefilter("ignore", UserWarning)
            done.close()


def _leave_ctrl_c_to_us() -> None:
    """A terminal sends Ctrl-C to every process; only the one that started the others answers."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


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
    with client:
        futures = client.map(do, works, software=software_digest(), pure=False)
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
