"""What the app's tests share."""

import pytest

from tests.app.fake_client import FakeClient


@pytest.fixture
def client():
    with FakeClient.on_a_server() as client:
        yield client
