import threading
from types import SimpleNamespace
from typing import Any

import pytest

from app.analysis.estimates import Estimates
from app.analysis.library import Entry, Opened
from app.errors import InputError
from app.panels.offline_page import SaveOfflinePage
from app.session.clock import PlaybackClock
from app.session.links import SavedSession
from app.session.outbox import Download
from app.session.tasks import Tasks
from estimator import Parameters
from recordings import RecordingError
from tests.app.fake_recordings import fake_opened, fake_recording
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


class Bench(SimpleNamespace):
    """As much of a workbench as the command needs."""

    def __init__(self):
        super().__init__(
            tasks=Tasks(self._receive),
            estimates=Estimates(),
            messages=[],
            pair=None,
            clock=PlaybackClock(fake_recording().stamps),
        )

    def _receive(self, event):
        self.messages += self.tasks.receive(event)

    def saved(self):
        return SavedSession("a", 0, Parameters())

    def begin(self, recording: Any = None) -> Holding:
        self.library = Holding(recording)
        self.opened = self.library.opened
        SaveOfflinePage().apply(self)  # pyright: ignore[reportArgumentType]
        return self.library

    @property
    def downloads(self):
        return [message for message in self.messages if isinstance(message, Download)]

    @property
    def notices(self):
        return [m.sentence for m in self.messages if not isinstance(m, Download)]


def test_the_page_arrives_when_it_is_ready():
    bench = Bench()
    bench.begin(fake_recording(name="a/b"))
    until(lambda: bench.downloads)
    (file,) = bench.downloads
    assert file.name == "a_b.html"
    assert b"<title>a/b</title>" in file.content
    assert any(said.startswith("a_b.html, ") for said in bench.notices)


def test_one_at_a_time_which_goes_on_when_its_recording_is_left_and_ends_with_the_client():
    recording, waiting, go_on = fake_recording(), threading.Event(), threading.Event()
    cloud = recording.cloud

    def slow(k, max_range=4.0):
        waiting.set()
        assert go_on.wait(10)
        return cloud(k, max_range)

    recording.cloud = slow
    bench = Bench()
    library = bench.begin(recording)
    assert waiting.wait(10)
    with pytest.raises(InputError, match="being made already"):
        bench.begin()
    assert library.users == 1
    bench.tasks.end()
    go_on.set()
    until(lambda: library.users == 0)
    until(lambda: not bench.tasks.states)
    assert not bench.downloads
    bench = Bench()
    library = bench.begin()
    until(lambda: bench.downloads)
    assert library.users == 0


def test_a_broken_recording_is_said_and_the_next_page_can_be_made():
    recording = fake_recording()

    def broken(k, max_range=4.0):
        raise RecordingError("fake.mcap is broken at frame 3.")

    recording.cloud = broken
    bench = Bench()
    library = bench.begin(recording)
    until(lambda: "fake.mcap is broken at frame 3." in bench.notices)
    assert library.users == 0
    until(lambda: not bench.tasks.states)
    bench.begin()
    until(lambda: bench.downloads)
