"""Settings and fixtures of all tests."""

from pathlib import Path

import pytest
from hypothesis import settings

import estimator.method
import estimator.parameters
from app.analysis import method_files

REPOSITORY = Path(__file__).resolve().parent.parent

# The same examples every time, so that a failure can be reproduced on any machine.
settings.register_profile("repeatable", derandomize=True, deadline=None, max_examples=40)
settings.load_profile("repeatable")


BROWSER = REPOSITORY / "tests" / "browser"
"""Tests in a real Chromium: all in one process, with one page."""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Keep a file's tests in one process, and begin with those that take longest."""
    long = [BROWSER, *(REPOSITORY / "tests" / "app" / room for room in ("commands", "study"))]
    for item in items:
        group = BROWSER if item.path.is_relative_to(BROWSER) else item.path
        item.add_marker(pytest.mark.xdist_group(str(group)))

    def rank(item: pytest.Item) -> int:
        ranks = [k for k, folder in enumerate(long) if item.path.is_relative_to(folder)]
        return ranks[0] if ranks else len(long)

    items.sort(key=rank)


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
