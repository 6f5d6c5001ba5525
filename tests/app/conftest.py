"""What the app's tests share."""

import pytest

from tests.app.fake_client import FakeClient


@pytest.fixture
def client():
    with FakeClient.on_a_server() as client:
        yield client


@pytest.fixture(autouse=True)
def _own_configuration(tmp_path_factory, monkeypatch):
    """Nothing of the person who runs the tests is read or changed."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path_factory.mktemp("config")))
