"""The flags that say where recordings are evaluated."""

import argparse
import os

from app.errors import InputError


def add_execution_flags(parser: argparse.ArgumentParser) -> None:
    """Add --jobs and --dask."""
    group = parser.add_argument_group("where it runs")
    group.add_argument(
        "--jobs",
        type=int,
        default=os.cpu_count() or 1,
        metavar="N",
        help="processes on this machine (default all cores)",
    )
    group.add_argument(
        "--dask",
        metavar="ADDRESS",
        help=(
            "run on the workers of a Dask scheduler instead, such as tcp://host:8786; they need "
            "the same Tofscope and see the same paths (needs tofscope[dask])"
        ),
    )


def check_jobs(options: argparse.Namespace) -> None:
    """Raise InputError where --jobs is no number of processes."""
    if options.jobs < 1:
        raise InputError(f"--jobs must be 1 or more, got {options.jobs}.")
