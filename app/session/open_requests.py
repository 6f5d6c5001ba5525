"""Opening of requested recordings, tried in turn until one opens."""

from collections.abc import Iterable, Sequence

from app.analysis.library import Entry, Library, Opened
from app.errors import InputError, UserError


class OpeningError(InputError):
    """Recordings that could not be opened.

    Attributes:
        title: says in short which.
    """

    def __init__(self, title: str, sentence: str) -> None:
        super().__init__(sentence)
        self.title = title


class OpenRequests:
    """Requested recordings, tried in turn until one opens.

    Args:
        library: opens recordings.
        entries: the recordings that may be opened, until others are listed.
    """

    def __init__(self, library: Library, entries: Sequence[Entry]) -> None:
        self._library = library
        self._requested: list[str] = []
        self._failures: dict[str, str] = {}
        self.allow(entries)

    @property
    def label(self) -> str | None:
        """Label of the recording to try next, None without a request."""
        return self._requested[0] if self._requested else None

    def allow(self, entries: Sequence[Entry]) -> None:
        """Let these recordings be opened from now on, and no others."""
        self._entries = {entry.label: entry for entry in entries}

    def request(self, labels: Iterable[str]) -> None:
        """Request recordings to try, in order; unlisted ones are ignored."""
        # A browser may send anything; only listed recordings are opened.
        self._requested = [label for label in labels if label in self._entries]

    def try_next(self) -> Opened | None:
        """Open the next one, or return None and keep the error for `raise_failure`."""
        label = self._requested.pop(0)
        try:
            opened = self._library.open(self._entries[label])
        except UserError as error:
            self._failures[label] = str(error)
            return None
        except Exception:
            self._requested.clear()
            raise
        self._requested.clear()
        return opened

    def raise_failure(self) -> None:
        """Raise OpeningError on those that could not be opened, once none is left to try."""
        if self._requested or not self._failures:
            return
        (label, first), *others = self._failures.items()
        self._failures.clear()
        more = f" {len(others)} more could not be opened." if others else ""
        raise OpeningError(f"{label} cannot be opened", first + more)
