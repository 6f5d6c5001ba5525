"""Files that appear under their name once they are complete."""

import os
from contextlib import suppress
from pathlib import Path
from typing import IO
from uuid import uuid4


class Draft:
    """File that is written; `complete` gives it its name, in place of what had it.

    Where the system can (Linux), it has no name until then, so that it goes with its process even
    if that is killed; elsewhere it has a name of its own beside it meanwhile.

    Args:
        path: of the complete file.

    Attributes:
        stream: for the content.

    Raises:
        OSError: it cannot be made.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        # A name of its own for every writer: two of them at once both succeed.
        self._part = path.with_name(f".tofscope-{uuid4().hex}.part")
        self.stream: IO[bytes] = _unnamed(path.parent) or self._part.open("xb")

    def complete(self) -> None:
        """Give the file its name.

        Raises:
            OSError: it cannot be written.
        """
        self.stream.flush()
        number = self.stream.fileno()
        os.fsync(number)  # some disks tell only now that they are full
        if os.fstat(number).st_nlink == 0:
            # With a folder given, whichever, Python follows the link to the file.
            os.link(f"/proc/self/fd/{number}", self._part, src_dir_fd=number)
        self.stream.close()
        os.replace(self._part, self._path)

    def discard(self) -> None:
        """Remove the file unless it is complete."""
        with suppress(OSError):  # on a full disk closing fails, too
            self.stream.close()
        with suppress(OSError):
            self._part.unlink(missing_ok=True)


def _unnamed(folder: Path) -> IO[bytes] | None:
    """New file without a name; None where the system has none."""
    if not hasattr(os, "O_TMPFILE") or not Path("/proc/self/fd").is_dir():
        return None
    try:
        return os.fdopen(os.open(folder, os.O_TMPFILE | os.O_WRONLY, 0o666), "wb")
    except OSError:  # this file system has none, or cannot be written, which the other way tells
        return None
