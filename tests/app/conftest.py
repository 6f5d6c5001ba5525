"""Fixtures shared by the app's tests."""

import time
from collections.abc import Iterator
from pathlib import Path

import pytest

import app.analysis.pair_estimator
from app.analysis.estimates import Estimates
from app.analysis.library import Library
from app.server.session import Session, Shared
from app.session.reload import Reloads
from estimator import Parameters
from recordings import RecordingError
from tests.app.dask_cluster import dask_scheduler
from tests.app.fake_client import FakeClient
from tests.app.fake_recordings import fake_recording
from tests.app.waiting import until


class Runs:
    """Runs of the estimator, which may be told to fail."""

    def __init__(self, monkeypatch):
        self.parameters, self.delay, self.error = [], 0.0, None
        real = app.analysis.pair_estimator.estimate

        def run(pair, parameters):
            self.parameters.append(parameters)
            time.sleep(self.delay)
            if self.error:
                raise self.error
            return real(pair, parameters)

        monkeypatch.setattr(app.analysis.pair_estimator, "estimate", run)

    def __len__(self):
        return len(self.parameters)


@pytest.fixture
def client():
    with FakeClient.on_a_server() as client:
        yield client


@pytest.fixture(autouse=True)
def _own_configuration(tmp_path_factory, monkeypatch):
    """Nothing of the person who runs the tests is read or changed."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path_factory.mktemp("config")))


@pytest.fixture
def runs(monkeypatch):
    return Runs(monkeypatch)


@pytest.fixture
def folder(tmp_path):
    for name in ("a.mcap", "b.mcap", "bad.mcap"):
        (tmp_path / name).touch()
    return tmp_path


@pytest.fixture
def shared(folder):
    def opener(path):
        if path.stem == "bad":
            raise RecordingError(f"{path} is no recording.")
        return fake_recording(name=path.stem)

    return Shared(Library([folder], opener), Estimates(), Reloads(), Parameters())


@pytest.fixture
def session(client, shared, runs):
    session = Session(client, shared)
    until(lambda: "Moving" in client.text() and client.shown("timeline.quantity"))
    yield session
    session.close()
    session.join(10)
    assert not session._thread.is_alive()


@pytest.fixture
def scheduler(tmp_path: Path) -> Iterator[str]:
    """Address of a scheduler with two worker processes, started for the test."""
    with dask_scheduler(tmp_path) as address:
        yield address
