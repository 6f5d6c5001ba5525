"""Opening of recordings: those that are wanted are tried one after the other."""

from collections.abc import Iterable, Sequence

from app.analysis.library import Entry, Library, Opened
from app.errors import InputError, UserError


class Opening:
    """Labels of recordings that are to be tried until one of them opens.

    Args:
        library: opens recordings.
        entries: the recordings that may be opened.
    """

    def __init__(self, library: Library, entries: Sequence[Entry]) -> None:
        self._library = library
        self._entries = {entry.label: entry for entry in entries}
        self._requested: list[str] = []
        self._failures: list[str] = []

    @property
    def label(self) -> str | None:
        """Label of the recording that is tried next, None where none is wanted."""
        return self._requested[0] if self._requested else None

    def request(self, labels: Iterable[str]) -> None:
        """Try these in their order; those that are not in the list are ignored."""
        # Only what the server listed is ever opened, whatever a browser sends.
        self._requested = [label for label in labels if label in self._entries]

    def try_next(self) -> Opened | None:
        """Open the next one; None where it cannot be opened, which `complain` tells in the end."""
        label = self._requested.pop(0)
        try:
            opened = self._library.open(self._entries[label])
        except UserError as error:
            self._failures.append(str(error))
            return None
        except Exception:
            self._requested.clear()
            raise
        self._requested.clear()
        return opened

    def raise_failure(self) -> None:
        """Raise InputError about those that could not be opened, once none is left to try."""
        if self._requested or not self._failures:
            return
        first, *others = self._failures
        self._failures.clear()
        more = f" {len(others)} more could not be opened." if others else ""
        raise InputError(first + more)
