"""The list that a session chooses from, and the neighbours of what is open."""

import pytest

from app.analysis.catalogue import Catalogue, Unreadable
from app.analysis.foreground import Foreground
from app.analysis.library import Library, Opened
from app.session.choice import Choice
from recordings import RecordingError
from tests.app.fake_recordings import fake_recording
from tests.app.waiting import until


def opener(path):
    if "bad" in path.stem:
        raise RecordingError(f"{path} is no recording.")
    return fake_recording(name=path.stem)


@pytest.fixture
def library(tmp_path):
    for name in ("a", "bad", "c", "d"):
        (tmp_path / f"{name}.mcap").touch()
    return Library([tmp_path], opener)


@pytest.fixture
def found():
    return {}


@pytest.fixture
def choice(library, found):
    catalogue = Catalogue(library, Foreground())
    return Choice(library, catalogue, library.listing(), found.update)


def opened(library: Library, label: str) -> Opened:
    [entry] = [entry for entry in library.listing() if entry.label == label]
    return Opened(entry, fake_recording(name=label), ("", 0, 0))


def test_a_look_sees_what_came_later_and_forgets_what_has_gone(choice, found, tmp_path):
    choice.look()
    until(lambda: len(found) == 4)
    choice.receive(found)
    assert isinstance(choice.listing.about["bad"], Unreadable)
    (tmp_path / "bad.mcap").unlink()
    (tmp_path / "later.mcap").touch()
    choice.look(show=True)
    assert [entry.label for entry in choice.listing.entries] == ["a", "c", "d", "later"]
    assert "bad" not in choice.listing.about
    assert "a" in choice.listing.about
    assert (choice.listing.looks, choice.listing.shown) == (2, 1)
    until(lambda: "later" in found)


def test_rows_that_are_not_there_are_not_preferred(choice):
    choice.look()
    choice.prefer([-1, 0, 4, 10**9])
    choice.leave()


def test_neighbours_are_the_next_ones_that_may_open(choice, library, found):
    assert choice.neighbours(opened(library, "a"), 1) == ["bad", "c", "d"]  # as far as known
    choice.look()
    until(lambda: len(found) == 4)
    assert choice.neighbours(opened(library, "a"), 1) == ["c", "d"]
    assert choice.neighbours(opened(library, "a"), 2) == ["d"]
    assert choice.neighbours(opened(library, "a"), 9) == ["d"]
    assert choice.neighbours(opened(library, "d"), -1) == ["c", "a"]
    assert choice.neighbours(opened(library, "d"), 1) == []
    assert choice.neighbours(opened(library, "a"), -1) == []
    assert choice.neighbours(None, 1) == ["a", "c", "d"]
