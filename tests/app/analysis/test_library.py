import os
import threading
from typing import Any

import pytest

from app.analysis.library import Entry, Library
from app.errors import InputError
from recordings import RecordingError
from tests.app.fake_recordings import fake_recording


class Opener:
    def __init__(self):
        self.opened = []

    def __call__(self, path):
        if "bad" in path.name:
            raise RecordingError(f"{path} is bad.")
        self.opened.append(path.name)
        return fake_recording(name=path.stem)


def touched(folder, *names):
    folder.mkdir(exist_ok=True, parents=True)
    for name in names:
        (folder / name).touch()
    return folder


def test_a_folder_lists_its_recordings_by_name(tmp_path):
    folder = touched(tmp_path / "f", "b.mcap", "a.mcap", "notes.txt")
    listing = Library([folder], Opener()).listing()
    assert [entry.label for entry in listing] == ["a", "b"]
    assert listing[0].path == folder / "a.mcap"


def test_files_are_listed_as_they_are_and_once(tmp_path):
    folder = touched(tmp_path / "f", "b.mcap", "a.bag")
    listing = Library([folder / "a.bag", folder, folder / "b.mcap"], Opener()).listing()
    assert [entry.label for entry in listing] == ["a", "b"]


def test_equal_names_get_their_folder_or_else_their_path(tmp_path):
    first = touched(tmp_path / "1" / "x", "a.mcap")
    second = touched(tmp_path / "2" / "x", "a.mcap")
    third = touched(tmp_path / "y", "a.mcap", "c.mcap")
    labels = [entry.label for entry in Library([first, second, third], Opener()).listing()]
    assert labels == [str(first / "a.mcap"), str(second / "a.mcap"), "y/a.mcap", "c"]


def test_labels_are_text_that_a_page_can_send_back(tmp_path):
    path = tmp_path / os.fsdecode(b"a\xff.mcap")
    try:
        path.touch()
    except OSError:
        pytest.skip("this file system takes no such names")
    (tmp_path / "\u00e4.mcap").touch()
    listing = Library([tmp_path], Opener()).listing()
    assert {entry.label for entry in listing} == {r"a\xff", "ä"}
    assert path in {entry.path for entry in listing}


def test_new_files_appear_in_the_next_listing(tmp_path):
    library = Library([touched(tmp_path / "f")], Opener())
    assert library.listing() == ()
    touched(tmp_path / "f", "new.mcap")
    assert [entry.label for entry in library.listing()] == ["new"]


def test_a_path_that_is_not_there_is_named(tmp_path):
    with pytest.raises(InputError, match=r"no file or folder .*nothing"):
        Library([tmp_path / "nothing"], Opener())


def test_a_recording_is_opened_once_and_closed_by_the_last_user(tmp_path):
    opener = Opener()
    library = Library([touched(tmp_path / "f", "a.mcap")], opener)
    (entry,) = library.listing()
    first, second = library.open(entry), library.open(entry)
    recording: Any = first.recording
    assert second.recording is recording
    library.release(entry)
    assert not recording.closed
    library.release(entry)
    assert recording.closed
    again = library.open(entry)
    assert opener.opened == ["a.mcap", "a.mcap"]
    assert again.key == first.key
    assert again.recording is not first.recording


def test_a_file_that_changed_has_another_key(tmp_path):
    folder = touched(tmp_path / "f", "a.mcap")
    library = Library([folder], Opener())
    (entry,) = library.listing()
    key = library.open(entry).key
    library.release(entry)
    (folder / "a.mcap").write_bytes(b"more")
    assert library.open(entry).key != key


def test_many_at_once_open_it_once(tmp_path):
    opener = Opener()
    library = Library([touched(tmp_path / "f", "a.mcap")], opener)
    (entry,) = library.listing()
    got: list[Any] = []
    threads = [
        threading.Thread(target=lambda: got.append(library.open(entry).recording)) for _ in range(8)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert opener.opened == ["a.mcap"]
    assert len({id(recording) for recording in got}) == 1
    for _ in got:
        library.release(entry)
    assert got[0].closed


def test_a_bad_file_raises_and_holds_nothing(tmp_path):
    library = Library([touched(tmp_path / "f", "bad.mcap")], Opener())
    (entry,) = library.listing()
    for _ in range(2):
        with pytest.raises(RecordingError, match="is bad"):
            library.open(entry)
    assert library._shared == {}


def test_an_entry_is_its_label_and_path(tmp_path):
    assert Entry("a", tmp_path) == Entry("a", tmp_path)


def test_folders_below_are_listed_by_their_names_and_hidden_ones_are_not(tmp_path):
    folder = touched(tmp_path / "f", "z.mcap")
    touched(folder / "day 1" / "morning", "a.mcap")
    touched(folder / "day 1", "a.mcap")
    touched(folder / ".trash", "old.mcap")
    labels = [entry.label for entry in Library([folder], Opener()).listing()]
    assert labels == ["z", "day 1/a", "day 1/morning/a"]


def test_links_that_leave_the_folder_are_not_followed(tmp_path):
    outside = touched(tmp_path / "outside", "secret.mcap")
    folder = touched(tmp_path / "f", "a.mcap")
    (folder / "folder").symlink_to(outside)
    (folder / "circle").symlink_to(folder)
    (folder / "file.mcap").symlink_to(outside / "secret.mcap")
    (folder / "b.mcap").symlink_to(folder / "a.mcap")
    assert [entry.label for entry in Library([folder], Opener()).listing()] == ["a", "b"]
    # What a person names is opened wherever it lies.
    assert [e.label for e in Library([folder / "file.mcap"], Opener()).listing()] == ["file"]
