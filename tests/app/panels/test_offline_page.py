import threading
from typing import Any

import pytest

from app.analysis.estimates import Estimates
from app.analysis.library import Entry, Opened
from app.errors import InputError
from app.panels.offline_page import OfflinePagePanel
from app.session.links import Place
from estimator import Parameters
from recordings import RecordingError
from tests.app.fake_recordings import fake_opened, fake_recording
from tests.app.fake_session import desk
from tests.app.waiting import until


class Holding:
    """A library of one recording, and how many hold it."""

    def __init__(self, recording: Any = None):
        self.opened, self.users = fake_opened(recording), 0

    def open(self, entry: Entry) -> Opened:
        assert entry == self.opened.entry
        self.users += 1
        return self.opened

    def release(self, entry: Entry) -> None:
        assert entry == self.opened.entry
        self.users -= 1


def begin(panel: OfflinePagePanel, recording: Any = None) -> Holding:
    library: Any = Holding(recording)
    panel.begin(library, library.opened.entry, Place("a", 0, Parameters()), Estimates())
    return library


def test_the_page_arrives_when_it_is_ready(client):
    panel = OfflinePagePanel(desk(client))
    begin(panel, fake_recording(name="a/b"))
    until(lambda: client.downloads)
    (name, content), *others = client.downloads
    assert (name, others) == ("a_b.html", [])
    assert b"<title>a/b</title>" in content
    until(lambda: any(said.startswith("a_b.html, ") for said in client.notifications))


def test_one_at_a_time_which_goes_on_when_its_recording_is_left_and_ends_with_the_client(client):
    recording, waiting, go_on = fake_recording(), threading.Event(), threading.Event()
    cloud = recording.cloud

    def slow(k, max_range=4.0):
        waiting.set()
        assert go_on.wait(30)
        return cloud(k, max_range)

    recording.cloud = slow
    panel = OfflinePagePanel(desk(client))
    library = begin(panel, recording)
    assert waiting.wait(30)
    with pytest.raises(InputError, match="being made already"):
        begin(panel)
    panel.close()
    assert library.users == 1
    panel.leave()
    go_on.set()
    until(lambda: library.users == 0)
    assert not client.downloads
    panel = OfflinePagePanel(desk(client))
    library = begin(panel)
    panel.close()
    until(lambda: client.downloads)
    until(lambda: library.users == 0)


def test_a_broken_recording_is_said_and_the_next_page_can_be_made(client):
    recording = fake_recording()

    def broken(k, max_range=4.0):
        raise RecordingError("fake.mcap is broken at frame 3.")

    recording.cloud = broken
    panel = OfflinePagePanel(desk(client))
    library = begin(panel, recording)
    until(lambda: "fake.mcap is broken at frame 3." in client.notifications)
    until(lambda: library.users == 0)
    until(lambda: panel._thread is not None and not panel._thread.is_alive())
    begin(panel)
    until(lambda: client.downloads)
