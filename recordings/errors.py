"""Errors of recordings."""

from collections.abc import Sequence

from robot_assets.errors import SentenceError

_FEW = 8


class RecordingError(SentenceError):
    """Recording that cannot be used; the message says what is wrong, where, and what to do."""


class BrokenFileError(RecordingError):
    """File with invalid bytes."""


class MisfitError(RecordingError):
    """Message that does not fit its type or its topic.

    The text is a reason that follows the message's name, such as "it is too short".
    """


def few(names: Sequence[str]) -> str:
    """Join names for a message: all of a few, else the first ones and the number of others."""
    if len(names) <= _FEW:
        return ", ".join(names)
    return f"{', '.join(names[:_FEW])} and {len(names) - _FEW} more"
