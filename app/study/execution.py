"""Execution of a study's work on local cores or on a Dask cluster."""

from collections.abc import Generator
from contextlib import closing
from functools import partial

from app.execution.each import Call, Place, results
from app.output.scratch import scratch_folder
from app.study.software import software_digest
from app.study.work import Outcome, Work, run_work


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
    files = works[0].method_files if works else ()
    # A common folder, since workers that are stopped cannot delete their own.
    with scratch_folder() as scratch:
        on_this_machine = None if dask else scratch
        run = partial(run_work, software=software_digest(files), scratch=on_this_machine)
        place = Place(jobs, dask, files, on_this_machine)
        with closing(results(Call(run, _failed), works, place)) as done:
            for _, outcome in done:
                yield outcome


def _failed(work: Work, reason: str) -> Outcome:
    return Outcome(work.source, failure=f"{work.source.name}: {reason}")
