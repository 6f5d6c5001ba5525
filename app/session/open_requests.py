"""Opening of requested recordings, tried in turn until one opens."""

from collections.abc import Iterable, Sequence

from app.analysis.catalogue import without_path
from app.analysis.library import Entry, Library, Opened
from app.errors import UserError
from app.session.outbox import OpeningFailed


class OpenRequests:
    """Requested recordings, tried in turn until one opens.

    Args:
        library: opens recordings.
        entries: the recordings that may be opened, until others are listed.
    """

    def __init__(self, library: Library, entries: Sequence[Entry]) -> None:
        self._library = library
        self._requested: list[str] = []
        self._failures: list[tuple[Entry, str]] = []
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
        """Open the next one, or return None and keep the error for `take_failure`."""
        entry = self._entries[self._requested.pop(0)]
        try:
            opened = self._library.open(entry)
        except UserError as error:
            self._failures.append((entry, without_path(str(error), entry)))
            return None
        except Exception:
            self._requested.clear()
            raise
        self._requested.clear()
        return opened

    def take_failure(self) -> OpeningFailed | None:
        """What could not be opened, once none is left to try, None where all could."""
        if self._requested or not self._failures:
            return None
        (entry, first), *others = self._failures
        self._failures.clear()
        more = f" {len(others)} more could not be opened." if others else ""
        return OpeningFailed(entry.label, first + more, entry.path)
