"""Writing of output files."""

import os
from pathlib import Path

from app.errors import InputError


def check_output(path: Path) -> None:
    """Check that a file can be written, before anything is computed for it.

    Raises:
        InputError: it cannot.
    """
    folder = path.absolute().parent
    if path.is_dir():
        raise InputError(f"{path} cannot be written: it is a folder.")
    if not folder.is_dir():
        raise InputError(f"{path} cannot be written: there is no folder {folder}.")
    if not os.access(path if path.exists() else folder, os.W_OK):
        raise InputError(f"{path} cannot be written: permission denied.")


def write(path: Path, content: bytes) -> None:
    """Write a file.

    Raises:
        InputError: it cannot be written.
    """
    try:
        path.write_bytes(content)
    except OSError as error:
        raise InputError(f"{path} cannot be written: {error.strerror}.") from error
