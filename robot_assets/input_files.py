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


def read_file(path: Path, most: int, kind: str, error: type[Exception]) -> bytes:
    """Content of a regular file of bounded size.

    Args:
        path: of the file.
        most: bytes that it may have.
        kind: of file that it is read as, such as "rig".
        error: raised with a sentence where it cannot be read, or is larger.
    """
    try:
        with open_file(path) as file:
            content = file.read(most + 1)
    except OSError as found:
        raise error(f"{path} cannot be read as a {kind} file: {found.strerror}.") from found
    if len(content) > most:
        raise error(
            f"{path} has more than {most} bytes, too many for a {kind} file; check the name."
        )
    return content
