"""Folders for temporary files, of which none stays: a later command removes a killed one's."""

import fcntl
import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from app.errors import InputError

_PREFIX = "tofscope-scratch-"


@contextmanager
def scratch_folder(parent: Path | None = None) -> Iterator[Path]:
    """Context of a new folder, which is removed at its end.

    A process that is killed cannot do so. Its folders are known by their lock, which ends with the
    process, and are removed by whoever needs a folder next.

    Args:
        parent: folder in which it is made; None: the system's for temporary files.

    Raises:
        InputError: no folder can be made.
    """
    try:
        where = parent or Path(tempfile.gettempdir())
        for left in where.glob(f"{_PREFIX}*"):
            _remove_abandoned(left)
        folder, lock = _locked(where)
    except OSError as error:
        raise InputError(
            f"There is no place for temporary files ({error.strerror}); set TMPDIR to a folder "
            "that can be written."
        ) from error
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        os.close(lock)


def _locked(where: Path) -> tuple[Path, int]:
    """A new folder, and the descriptor that holds its lock."""
    while True:
        folder = Path(tempfile.mkdtemp(prefix=_PREFIX, dir=where))
        lock = os.open(folder, os.O_RDONLY)
        with suppress(OSError):  # some file systems have no locks: there nothing is removed either
            fcntl.flock(lock, fcntl.LOCK_EX)
        # Before it had a lock it could be taken for an abandoned one.
        if folder.is_dir():
            return folder, lock
        os.close(lock)


def _remove_abandoned(folder: Path) -> None:
    """Remove a folder of ours that no process has locked."""
    with suppress(OSError):
        lock = os.open(folder, os.O_RDONLY | os.O_NOFOLLOW)
        try:
            if os.fstat(lock).st_uid == os.getuid():
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                shutil.rmtree(folder, ignore_errors=True)
        finally:
            os.close(lock)
