"""Marks of a recording, in a file beside it."""

import json
from pathlib import Path

import numpy as np
import pytest

import app.output.checks
import app.session.marks
from app.errors import InputError
from app.session.marks import LONGEST_NOTE, Mark, Marks

STAMPS = 100 + np.arange(20) / 15


def marks(folder: Path, stamps: np.ndarray = STAMPS) -> Marks:
    """Marks of a recording in a folder, as a new session finds them."""
    path = folder / "my.walk.mcap"
    path.touch()
    found = Marks(path, stamps)
    found.load()
    return found


def test_they_are_found_again_in_the_order_of_their_frames(tmp_path):
    first = marks(tmp_path)
    assert first.known == ()
    assert not first.file.exists()
    first.put(7, "it stops ✋ <b>")
    first.put(3, "")
    assert first.file == tmp_path / "my.walk.mcap.marks.json"
    assert first.known == marks(tmp_path).known == (Mark(3, ""), Mark(7, "it stops ✋ <b>"))


def test_the_file_says_what_it_is_and_names_the_recording(tmp_path):
    first = marks(tmp_path)
    first.put(3, "here")
    content = json.loads(first.file.read_text("utf-8"))
    assert content == {
        "tofscope": "marks",
        "recording": "my.walk.mcap",
        "marks": [{"stamp": STAMPS[3], "text": "here"}],
    }


def test_a_mark_is_replaced_and_removed(tmp_path):
    first = marks(tmp_path)
    for frame, text in ((3, "a"), (7, "b"), (3, "c")):
        first.put(frame, text)
    assert first.known == (Mark(3, "c"), Mark(7, "b"))
    first.remove(3)
    first.remove(11)  # where there is none
    assert first.known == marks(tmp_path).known == (Mark(7, "b"),)
    first.remove(7)
    assert marks(tmp_path).known == ()


def test_frames_are_clipped_and_notes_cut(tmp_path):
    first = marks(tmp_path)
    first.put(-3, "x" * (LONGEST_NOTE + 1))
    first.put(10**6, "last")
    assert first.known == (Mark(0, "x" * LONGEST_NOTE), Mark(19, "last"))


def test_they_stay_at_their_times_when_frames_are_told_apart_in_another_way(tmp_path):
    first = marks(tmp_path)
    first.put(8, "here")
    first.put(9, "and here")
    assert marks(tmp_path, STAMPS[4:]).known == (Mark(4, "here"), Mark(5, "and here"))
    # Of two at one frame the last counts.
    assert marks(tmp_path, STAMPS[::8]).known == (Mark(1, "and here"),)


def test_what_another_session_put_meanwhile_stays(tmp_path):
    mine, theirs = marks(tmp_path), marks(tmp_path)
    theirs.put(3, "theirs")
    mine.put(7, "mine")
    assert mine.known == (Mark(3, "theirs"), Mark(7, "mine"))


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"{",
        b"\xff\xfe",
        b"[]",
        b"[" * 100_000,
        b'{"recording": "my.walk.mcap"}',
        b'{"tofscope": "preset", "recording": "a", "marks": []}',
        b'{"tofscope": "marks", "recording": "a", "marks": [{"stamp": "1", "text": "a"}]}',
        b'{"tofscope": "marks", "recording": "a", "marks": [{"stamp": NaN, "text": "a"}]}',
        b'{"tofscope": "marks", "recording": "a", "marks": [{"stamp": 1e999, "text": "a"}]}',
        b'{"tofscope": "marks", "recording": "a", "marks": [{"stamp": 1.0, "text": "%s"}]}'
        % (b"x" * (LONGEST_NOTE + 1)),
    ],
)
def test_a_damaged_or_foreign_file_is_told_and_never_overwritten(tmp_path, content):
    first = marks(tmp_path)
    first.file.write_bytes(content)
    sentence = f"{first.file} holds no marks of Tofscope; move it away to put marks here."
    for attempt in (first.load, lambda: first.put(3, "here"), lambda: first.remove(3)):
        with pytest.raises(InputError) as raised:
            attempt()
        assert str(raised.value) == sentence
        assert first.known == ()
    assert first.file.read_bytes() == content


def test_a_file_that_is_too_large_or_no_file_is_told(tmp_path, monkeypatch):
    first = marks(tmp_path)
    first.put(3, "here")
    monkeypatch.setattr(app.session.marks, "_LARGEST", 10)
    with pytest.raises(InputError, match="is too large for a file of marks"):
        first.load()
    first.file.unlink()
    first.file.mkdir()
    for attempt in (first.load, lambda: first.put(3, "here")):
        with pytest.raises(InputError, match=r"my\.walk\.mcap\.marks\.json"):
            attempt()


def test_a_folder_that_cannot_be_written_is_one_sentence(tmp_path, monkeypatch):
    first = marks(tmp_path)
    monkeypatch.setattr(app.output.checks.os, "access", lambda *_: False)
    with pytest.raises(InputError) as raised:
        first.put(3, "here")
    assert str(raised.value) == f"{first.file} cannot be written: permission denied."
    assert first.known == ()
    assert not first.file.exists()


def test_there_are_not_too_many(tmp_path, monkeypatch):
    monkeypatch.setattr(app.session.marks, "_MOST", 2)
    first = marks(tmp_path)
    first.put(1, "")
    first.put(2, "")
    with pytest.raises(InputError, match="at most 2 marks"):
        first.put(3, "")
    first.put(2, "again")
    assert len(first.known) == 2
