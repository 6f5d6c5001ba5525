"""What is in listed recordings is found out one after the other, and kept."""

import threading

import pytest

from app.analysis.catalogue import Catalogue, Facts, Unreadable
from app.analysis.foreground import Foreground
from app.analysis.library import Entry, Library
from recordings import Provenance, RecordingError
from tests.app.fake_recordings import fake_recording
from tests.app.waiting import until


class Opener:
    def __init__(self):
        self.opened, self.open_now, self.most = [], [], 0

    def __call__(self, path):
        self.opened.append(path.stem)
        if "bad" in path.stem:
            raise RecordingError(f"{path} is no recording.")
        if "far" in path.stem:
            raise RecordingError(f"{path}: no sensor of {path} can be placed.")
        if "odd" in path.stem:
            raise ValueError("odd")
        recording = fake_recording(name=path.stem)
        self.open_now.append(recording)
        self.most = max(self.most, sum(not r.closed for r in self.open_now))
        if "sim" in path.stem:
            recording.simulated = True
            recording.provenance = Provenance(True, "towards", 0.25, 3, 7, "", "")
        return recording


@pytest.fixture
def opener():
    return Opener()


@pytest.fixture
def library(tmp_path, opener):
    for name in ("a", "bad", "odd", "sim", "z"):
        (tmp_path / f"{name}.mcap").touch()
    return Library([tmp_path], opener)


@pytest.fixture
def catalogue(library):
    return Catalogue(library, Foreground())


def found(catalogue, entries):
    """All that is told of these."""
    told = {}
    catalogue.request("one", entries, told.update)
    until(lambda: len(told) == len(entries))
    return told


def test_facts_of_good_ones_and_reasons_of_bad_ones(catalogue, library, opener, tmp_path, caplog):
    told = found(catalogue, library.listing())
    assert told["a"] == Facts(False, "", told["a"].seconds, 40, 1, truth=True)
    assert told["a"].seconds == pytest.approx(39 / 15)
    assert told["sim"].simulated
    assert told["sim"].scenario == "towards, 0.25 m/s, trial 3"
    assert told["bad"] == Unreadable("It is no recording.")
    assert told["odd"] == Unreadable("It cannot be opened (ValueError: odd).")
    assert "odd.mcap could not be looked at" in caplog.text
    assert opener.most == 1
    assert all(recording.closed for recording in opener.open_now)


def test_what_is_known_is_not_opened_again_until_the_file_changes(catalogue, library, opener):
    entries = library.listing()
    assert catalogue.known(entries[0]) is None
    found(catalogue, entries)
    opener.opened.clear()
    assert len(found(catalogue, entries)) == 5
    assert opener.opened == []
    entries[0].path.write_bytes(b"more")
    assert catalogue.known(entries[0]) is None
    found(catalogue, entries)
    assert opener.opened == ["a"]


def test_what_is_seen_is_opened_first_and_an_open_one_is_shared(catalogue, library, opener):
    entries = library.listing()
    library.open(entries[0])
    catalogue._foreground.__enter__()  # holds the catalogue back for a moment
    told = {}
    catalogue.request("one", entries, told.update)
    catalogue.prefer("one", ["nothing", "z", "sim"])
    catalogue._foreground.__exit__(None, None, None)
    until(lambda: len(told) == 5)
    # The first may have been under way.
    assert [name for name in opener.opened[1:] if name not in ("bad", "odd")] == ["z", "sim"]
    assert opener.opened.count("a") == 1
    library.release(entries[0])


def test_a_request_that_is_cancelled_is_not_told_of_and_the_thread_ends(library):
    started, go_on = threading.Event(), threading.Event()

    class Held(Foreground):
        def wait_until_quiet(self, seconds, at_most=0.0) -> bool:
            started.set()
            return go_on.wait(10)

    catalogue, told = Catalogue(library, Held()), {}
    catalogue.request("one", library.listing(), told.update)
    assert started.wait(10)
    catalogue.cancel("one")
    go_on.set()
    until(lambda: not any(t.name == "catalogue" for t in threading.enumerate()))
    assert told == {}


def test_a_file_that_has_gone_says_so_and_is_not_remembered(catalogue, tmp_path, opener):
    far = Entry("far", tmp_path / "far.mcap")
    said = "No sensor of far.mcap can be placed."
    assert found(catalogue, [far])["far"] == Unreadable(said)
    gone = Entry("bad", tmp_path / "bad2.mcap")
    assert found(catalogue, [gone])["bad"] == Unreadable("It is no recording.")
    assert catalogue.known(gone) is None
