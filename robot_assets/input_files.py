"""Opening of files that are read: regular ones alone, since others may wait or go on for ever."""

import errno
import os
import stat
from collections.abc import Callable
from io import BufferedReader
from pathlib import Path

_OTHERS: tuple[tuple[Callable[[int], bool], int, str], ...] = (
    (stat.S_ISDIR, errno.EISDIR, "it is a folder"),
    (
        stat.S_ISFIFO,
        errno.ESPIPE,
        "it is a pipe, which cannot be read from any place; save its content to a file first",
    ),
    (stat.S_ISSOCK, errno.ESPIPE, "it is a socket; save its content to a file first"),
)


def open_file(path: Path) -> BufferedReader:
    """Open a regular file for reading.

    Raises:
        OSError: it cannot be opened, or is not a regular file; its `strerror` says why.
    """
    mode = os.stat(path).st_mode
    for is_kind, number, said in _OTHERS:
        if is_kind(mode):
            raise OSError(number, said, str(path))
    if not stat.S_ISREG(mode):
        raise OSError(errno.ESPIPE, "it is a device and not a regular file", str(path))
    return path.open("rb")
