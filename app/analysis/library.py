"""Recordings that the app lists, opened once and shared by sessions."""

import itertools
import os
import threading
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from app.errors import InputError
from recordings import Recording

_MOST_FOLDERS = 20_000
"""Folders below a given one that are looked into: somebody may give the root of the disk."""


@dataclass(frozen=True)
class Entry:
    """A listed recording.

    Attributes:
        label: shown to the user, unique in the list.
        path: of the file.
    """

    label: str
    path: Path


@dataclass(frozen=True)
class Opened:
    """An open recording.

    Attributes:
        entry: its entry in the list.
        recording: safe to use from several threads.
        key: identity of the file's content, under which results stay cached after it is closed.
        number: of this opening; another one where the same file is opened again.
    """

    entry: Entry
    recording: Recording
    key: tuple[str, int, int]
    number: int = field(default_factory=itertools.count().__next__)


class _Shared:
    def __init__(self) -> None:
        self.lock = threading.Lock()
        self.users = 0
        self.opened: Opened | None = None


class Library:
    """Lists recordings and keeps each open while a session uses it.

    Args:
        paths: files, and folders whose *.mcap files are listed, with those of the folders in them.
        open_recording: opens the recording at a path.

    Raises:
        InputError: a path does not exist.
    """

    def __init__(self, paths: Sequence[Path], open_recording: Callable[[Path], Recording]) -> None:
        self.paths = tuple(path.absolute() for path in paths)
        for path in self.paths:
            if not path.exists():
                raise InputError(f"There is no file or folder {path}; check the spelling.")
        self._open_recording = open_recording
        self._lock = threading.Lock()
        self._shared: dict[Entry, _Shared] = {}

    def listing(self) -> tuple[Entry, ...]:
        """Recordings that exist now, in the order of the paths, then of the file names."""
        names: dict[Path, str] = {}
        for path in self.paths:
            if path.is_dir():
                for file in _files_in(path):
                    names.setdefault(file, file.relative_to(path).with_suffix("").as_posix())
            else:
                names.setdefault(path, path.stem)
        return tuple(map(Entry, _labels(names), names))

    def open(self, entry: Entry) -> Opened:
        """Open a recording, or share the open one; each call needs a `release`.

        Raises:
            RecordingError: it cannot be opened.
        """
        with self._lock:
            shared = self._shared.setdefault(entry, _Shared())
            shared.users += 1
        try:
            with shared.lock:
                if shared.opened is None:
                    recording = self._open_recording(entry.path)
                    status = entry.path.stat()
                    key = (str(entry.path), status.st_mtime_ns, status.st_size)
                    shared.opened = Opened(entry, recording, key)
                return shared.opened
        except BaseException:
            self.release(entry)
            raise

    def release(self, entry: Entry) -> None:
        """Release a recording; the last release closes it."""
        with self._lock:
            shared = self._shared[entry]
            shared.users -= 1
            if shared.users > 0:
                return
            del self._shared[entry]
        if shared.opened is not None:
            shared.opened.recording.close()


def _files_in(folder: Path) -> Iterator[Path]:
    """The *.mcap files of a folder by name, then those of each folder in it.

    Nothing outside of it is listed: links to folders are not followed, and links to files only
    where they stay inside. Hidden folders are left out.
    """
    inside = folder.resolve()
    for walked, (where, folders, files) in enumerate(os.walk(folder)):
        if walked == _MOST_FOLDERS:
            return
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        for name in sorted(files):
            path = Path(where, name)
            leaves = path.is_symlink() and inside not in path.resolve().parents
            if path.suffix == ".mcap" and not leaves:
                yield path


def _labels(names: Mapping[Path, str]) -> list[str]:
    r"""Names of files where unique, else folder and name, else the whole path.

    Bytes of names that are no text are escapes, such as \xff: a page cannot send them back.

    Args:
        names: {file: its name below the folder that was opened, without its ending}.
    """
    labels = [_readable(name) for name in names.values()]
    for longer in (lambda path: f"{path.parent.name}/{path.name}", str):
        count = Counter(labels)
        labels = [
            _readable(longer(path)) if count[label] > 1 else label
            for path, label in zip(names, labels, strict=True)
        ]
    return labels


def _readable(name: str) -> str:
    return os.fsencode(name).decode("utf-8", "backslashreplace")
