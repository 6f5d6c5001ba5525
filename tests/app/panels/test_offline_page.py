import threading

import pytest

from app.errors import InputError
from app.estimates import Estimates
from app.panels.offline_page import OfflinePagePanel
from app.places import Place
from estimator import Parameters
from recordings import RecordingError
from tests.app.fake_recordings import fake_opened, fake_recording
from tests.app.fake_session import desk
from tests.app.waiting import until


def begin(panel: OfflinePagePanel, opened) -> None:
    panel.begin(opened, Place("a", 0, Parameters()), Estimates())


def test_the_page_arrives_when_it_is_ready(client):
    panel = OfflinePagePanel(desk(client))
    begin(panel, fake_opened(fake_recording(name="a/b")))
    until(lambda: client.downloads)
    (name, content), *others = client.downloads
    assert (name, others) == ("a_b.html", [])
    assert b"<title>a/b</title>" in content
    until(lambda: any(said.startswith("a_b.html, ") for said in client.notifications))


def test_one_at_a_time_and_none_of_a_recording_that_is_left(client):
    recording, waiting, go_on = fake_recording(), threading.Event(), threading.Event()
    cloud = recording.cloud

    def slow(k, max_range=4.0):
        waiting.set()
        assert go_on.wait(30)
        return cloud(k, max_range)

    recording.cloud = slow
    panel = OfflinePagePanel(desk(client))
    begin(panel, fake_opened(recording))
    assert waiting.wait(30)
    with pytest.raises(InputError, match="being made already"):
        begin(panel, fake_opened(recording))
    threading.Timer(0.2, go_on.set).start()
    panel.close()
    assert not client.downloads
    begin(panel, fake_opened())  # of the next recording
    until(lambda: client.downloads)


def test_a_broken_recording_is_said_and_the_next_page_can_be_made(client):
    recording = fake_recording()

    def broken(k, max_range=4.0):
        raise RecordingError("fake.mcap is broken at frame 3.")

    recording.cloud = broken
    panel = OfflinePagePanel(desk(client))
    begin(panel, fake_opened(recording))
    until(lambda: "fake.mcap is broken at frame 3." in client.notifications)
    panel.close()
    begin(panel, fake_opened())
    until(lambda: client.downloads)
