"""Writing of files that are whole or as they were before."""

import contextlib
import os
import time
from pathlib import Path
from uuid import uuid4

from app.errors import InputError

DRAFT = ".tofscope-{}.part"
"""Name of what is being written, until it is whole."""

_ABANDONED = 3600.0
"""Seconds after which a draft, which is written in a few, is that of a process that was killed."""


def write(path: Path, content: bytes) -> None:
    """Write a file beside its place and rename it, so that a failure leaves what was there.

    Drafts that killed processes left in the folder are removed. A link is followed. Devices and
    pipes, such as /dev/stdout, are written to as they are.

    Raises:
        InputError: it cannot be written.
    """
    try:
        if path.exists() and not path.is_file():
            path.write_bytes(content)
        else:
            _replace(path.resolve(), content)
    except OSError as error:
        raise InputError(f"{path} cannot be written: {error.strerror}.") from error


def _replace(path: Path, content: bytes) -> None:
    _remove_abandoned(path.parent)
    # A name of its own for every writer: two of them at once both succeed.
    draft = path.with_name(DRAFT.format(uuid4().hex))
    try:
        with draft.open("xb") as stream:
            stream.write(content)
            stream.flush()
            # Some file systems tell only now that they are full.
            os.fsync(stream.fileno())
        if path.exists():
            draft.chmod(path.stat().st_mode & 0o777)
        os.replace(draft, path)
    except BaseException:
        with contextlib.suppress(OSError):
            draft.unlink(missing_ok=True)
        raise


def _remove_abandoned(folder: Path) -> None:
    latest = time.time() - _ABANDONED
    for draft in folder.glob(DRAFT.format("*")):
        with contextlib.suppress(OSError):
            if draft.stat().st_mtime < latest:
                draft.unlink()
