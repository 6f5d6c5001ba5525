from pathlib import Path
from typing import Any

import pytest

from app.analysis.library import Entry
from app.session.open_requests import OpenRequests
from app.session.outbox import OpeningFailed
from recordings import RecordingError

ENTRIES = [Entry(label, Path(f"/nowhere/{label}.mcap")) for label in ("a", "bad", "worse", "odd")]


class Library:
    def open(self, entry):
        if entry.label == "odd":
            raise RuntimeError("odd")
        if entry.label != "a":
            raise RecordingError(f"{entry.path} is no recording.")
        return entry


def opening(*labels: str) -> OpenRequests:
    library: Any = Library()
    made = OpenRequests(library, ENTRIES)
    made.request(labels)
    return made


def test_they_are_tried_in_their_order_until_one_opens():
    wanted = opening("bad", "a", "worse")
    assert wanted.label == "bad"
    assert wanted.try_next() is None
    assert wanted.take_failure() is None  # there is another to try
    assert wanted.label == "a"
    assert wanted.try_next() == ENTRIES[0]
    assert wanted.label is None
    assert wanted.take_failure() == OpeningFailed("bad", "It is no recording.", ENTRIES[1].path)
    assert wanted.take_failure() is None  # once


def test_where_none_opens_the_first_is_told_and_the_others_are_counted():
    wanted = opening("bad", "worse")
    assert wanted.try_next() is None
    assert wanted.try_next() is None
    failed = wanted.take_failure()
    assert failed is not None
    assert failed.label == "bad"
    assert failed.reason == "It is no recording. 1 more could not be opened."


def test_only_what_is_listed_is_tried():
    assert opening("/etc/passwd", "a").label == "a"
    assert opening("later").label is None


def test_after_an_unexpected_error_nothing_else_is_tried():
    wanted = opening("odd", "a")
    with pytest.raises(RuntimeError):
        wanted.try_next()
    assert wanted.label is None
