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


LONG = [REPOSITORY / "tests" / room for room in ("browser", "app/commands", "app/study")]


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Begin with what takes longest, so that of several processes none is left with it alone."""
    items.sort(key=lambda item: not any(item.path.is_relative_to(folder) for folder in LONG))


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
