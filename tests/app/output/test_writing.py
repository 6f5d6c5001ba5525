"""Files that are whole or as they were before."""

import errno
import os
import threading
import time
from pathlib import Path

import pytest

from app.errors import InputError
from app.output.writing import write


def test_a_new_file_and_one_in_place_of_another(tmp_path: Path):
    path = tmp_path / "a.json"
    write(path, b"1")
    path.chmod(0o640)
    write(path, b"22")
    assert path.read_bytes() == b"22"
    assert path.stat().st_mode & 0o777 == 0o640
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("broken", ["fsync", "replace"])
def test_a_failure_leaves_what_was_there_and_nothing_beside_it(
    broken: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    path = tmp_path / "a.json"
    path.write_bytes(b"before")
    monkeypatch.setattr(f"app.output.writing.os.{broken}", full)
    with pytest.raises(InputError, match=r"a\.json cannot be written: No space left on device\."):
        write(path, b"after")
    assert path.read_bytes() == b"before"
    assert list(tmp_path.iterdir()) == [path]


def test_an_interruption_leaves_nothing_beside_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("app.output.writing.os.fsync", interrupt)
    with pytest.raises(KeyboardInterrupt):
        write(tmp_path / "a.json", b"after")
    assert not list(tmp_path.iterdir())


def test_drafts_of_killed_processes_are_removed_and_those_of_others_are_not(tmp_path: Path):
    for name, age in (("old", 7200), ("new", 60)):
        draft = tmp_path / f".tofscope-{name}.part"
        draft.touch()
        then = time.time() - age
        os.utime(draft, (then, then))
    write(tmp_path / "a.json", b"content")
    assert {path.name for path in tmp_path.iterdir()} == {"a.json", ".tofscope-new.part"}


def test_a_link_is_followed(tmp_path: Path):
    place, link = tmp_path / "place.json", tmp_path / "link.json"
    place.write_bytes(b"before")
    link.symlink_to(place)
    write(link, b"after")
    assert link.is_symlink()
    assert place.read_bytes() == b"after"


def test_a_device_is_written_to_as_it_is():
    write(Path(os.devnull), b"anything")
    assert Path(os.devnull).is_char_device()


def test_many_writers_of_one_file_all_succeed_and_no_reader_finds_half_of_one(tmp_path: Path):
    path, contents, failed = tmp_path / "a", [bytes([k]) * 50_000 for k in range(4)], []
    write(path, contents[0])

    def save(content: bytes) -> None:
        try:
            for _ in range(25):
                write(path, content)
        except InputError as error:
            failed.append(error)

    threads = [threading.Thread(target=save, args=(content,)) for content in contents]
    for thread in threads:
        thread.start()
    while any(thread.is_alive() for thread in threads):
        assert path.read_bytes() in contents
    assert not failed
    assert list(tmp_path.iterdir()) == [path]
