"""What can be wrong with a recording, in words."""

from collections.abc import Sequence

_FEW = 8


class RecordingError(Exception):
    """A recording that cannot be used; one sentence says what, where, and what to do."""


class BrokenFileError(RecordingError):
    """Bytes of a file that cannot be what they should be."""


def few(names: Sequence[str]) -> str:
    """Names for a sentence: all where they are few, else the first ones and how many more."""
    if len(names) <= _FEW:
        return ", ".join(names)
    return f"{', '.join(names[:_FEW])} and {len(names) - _FEW} more"
