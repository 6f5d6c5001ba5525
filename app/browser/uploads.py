"""Bound of what a client may have uploaded before its files are complete."""

from dataclasses import dataclass, field
from enum import Enum, auto

LARGEST_UPLOAD = 1_000_000
"""Bytes of all incomplete files of a client; viser keeps them in memory."""

_PART = 4096  # bytes that a part has at least, on average; pages send half a megabyte
_REFUSALS = 16  # refused files whose parts are still expected


class Part(Enum):
    """What becomes of a part of a file."""

    TAKEN = auto()
    LEFT_OUT = auto()
    """Of a refused file."""
    UNEXPECTED = auto()
    """Of no file that was announced, or more of one than was announced."""


@dataclass
class _Pending:
    parts: int
    size: int
    came: int = 0
    seen: set[int] = field(default_factory=set)


class Uploads:
    """Incomplete uploads of one client."""

    def __init__(self) -> None:
        self._pending: dict[str, _Pending] = {}
        self._refused: dict[str, None] = {}

    def begin(self, upload: str, parts: int, size: int) -> bool:
        """Whether a file is taken.

        Args:
            upload: its identity, made by the client.
            parts: in which it will come.
            size: in bytes.

        Raises:
            ValueError: no page announces a file so.
        """
        whole = 0 <= parts <= 1 + size // _PART and size >= 0 and (parts == 0) == (size == 0)
        if upload in self._pending or not whole:
            raise ValueError(f"a file of {size} bytes in {parts} parts")
        if size + sum(pending.size for pending in self._pending.values()) > LARGEST_UPLOAD:
            self._refused[upload] = None
            if len(self._refused) > _REFUSALS:
                del self._refused[next(iter(self._refused))]
            return False
        if parts:
            self._pending[upload] = _Pending(parts, size)
        return True

    def take(self, upload: str, index: int, size: int) -> Part:
        """What becomes of a part: its number in the file from 0, and its bytes."""
        if upload in self._refused:
            return Part.LEFT_OUT
        pending = self._pending.get(upload)
        if pending is None or index in pending.seen or not 0 <= index < pending.parts:
            return Part.UNEXPECTED
        if pending.came + size > pending.size:
            return Part.UNEXPECTED
        pending.seen.add(index)
        pending.came += size
        if len(pending.seen) == pending.parts:
            del self._pending[upload]
        return Part.TAKEN
