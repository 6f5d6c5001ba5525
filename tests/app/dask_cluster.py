"""A small Dask cluster of its own for a test."""

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest

from tests.app.waiting import until
from tests.conftest import REPOSITORY


@contextmanager
def dask_scheduler(folder: Path) -> Iterator[str]:
    """Context of the address of a scheduler with two worker processes that run in a folder."""
    distributed = pytest.importorskip("distributed", reason="distributed is not installed")
    file = folder / "scheduler.json"
    common = ["--scheduler-file", str(file), "--no-dashboard"]
    environment = os.environ | {"PYTHONPATH": str(REPOSITORY)}
    with ExitStack() as stack:

        def start(*arguments: str) -> None:
            process = stack.enter_context(
                subprocess.Popen(
                    [sys.executable, "-m", "dask", *arguments, *common],
                    cwd=folder,
                    env=environment,
                    stderr=subprocess.DEVNULL,
                )
            )
            stack.callback(process.terminate)

        start("scheduler", "--host", "127.0.0.1", "--port", "0")
        until(file.exists)
        for _ in range(2):
            start("worker", "--nthreads", "1", "--no-nanny", "--host", "127.0.0.1")
        address = json.loads(file.read_text())["address"]
        with distributed.Client(address, set_as_default=False) as client:
            client.wait_for_workers(2, timeout=10)
        yield address
