"""Settings and fixtures of all tests."""

import resource
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import settings
from xdist.remote import Producer
from xdist.scheduler import LoadFileScheduling

import estimator.method
import estimator.parameters
from app.analysis import method_files

REPOSITORY = Path(__file__).resolve().parent.parent

# The same examples every time, so that a failure can be reproduced on any machine.
settings.register_profile("repeatable", derandomize=True, deadline=None, max_examples=40)
settings.load_profile("repeatable")


EXPORTS = "tests/browser/test_export_in_chromium.py"
LONG = ("tests/browser/", "tests/app/commands/", "tests/app/study/")


def pytest_configure(config: pytest.Config) -> None:
    """Compile the engine once, before several processes would."""
    if not hasattr(config, "workerinput"):
        subprocess.run([sys.executable, "-m", "estimator.engine.readiness"], check=True)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Begin with what takes longest, so that of several processes none is left with it alone."""

    def order(item: pytest.Item) -> int:
        return next((i for i, room in enumerate(LONG) if item.nodeid.startswith(room)), len(LONG))

    items.sort(key=order)


class FileScheduling(LoadFileScheduling):
    """Division of the tests by files, with browser tests in one process and one Chromium.

    Exports start a Chromium each, and are another process's.
    """

    def _split_scope(self, nodeid: str) -> str:
        shared = nodeid.startswith(LONG[0]) and not nodeid.startswith(EXPORTS)
        return LONG[0] if shared else super()._split_scope(nodeid)


def pytest_xdist_make_scheduler(config: pytest.Config, log: Producer) -> FileScheduling:
    """Use `FileScheduling` for every run in several processes."""
    return FileScheduling(config, log)


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """Recordings that are no part of this repository; tests that need them skip without."""
    folder = REPOSITORY.parent / "shared" / "data"
    if not folder.is_dir():
        pytest.skip(f"{folder} is not here: it holds recordings made by others")
    return folder


@pytest.fixture
def methods_of_a_test(monkeypatch: pytest.MonkeyPatch) -> None:
    """Methods that are registered meanwhile are forgotten after the test."""
    for module in (estimator.method, estimator.parameters):
        monkeypatch.setattr(module, "_METHODS", dict(module._METHODS))
    monkeypatch.setattr(method_files, "_loaded", {})


@pytest.fixture
def full_disk() -> Iterator[None]:
    """Files that this process writes end at 20 kB, as on a full disk."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, before[1]))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, before)
