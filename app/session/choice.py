"""The list of recordings that a session chooses from."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from app.analysis.catalogue import About, Catalogue, Unreadable
from app.analysis.library import Entry, Library, Opened


@dataclass(frozen=True)
class Listing:
    """Recordings to choose from, and what is known of them.

    Attributes:
        entries: in the order of the list.
        about: {label: what is in it, or why it cannot be opened}, as far as known.
        looks: number of times that the files were looked at so far.
        shown: number of times that a command asked to show the list so far.
    """

    entries: tuple[Entry, ...]
    about: Mapping[str, About] = field(default_factory=dict)
    looks: int = 0
    shown: int = 0


class Choice:
    """Recordings to choose from; used by the session's thread alone.

    Args:
        library: lists the recordings.
        catalogue: finds out what is in them.
        entries: listed when the session began.
        notify: called by the catalogue's thread with what was found; the session's thread must
            pass it to `receive`.

    Attributes:
        listing: as it is now.
    """

    def __init__(
        self,
        library: Library,
        catalogue: Catalogue,
        entries: Sequence[Entry],
        notify: Callable[[Mapping[str, About]], None],
    ) -> None:
        self._library, self._catalogue, self._notify = library, catalogue, notify
        self.listing = Listing(tuple(entries))

    def look(self, *, show: bool = False) -> None:
        """List what exists now, and begin to find out what is in it.

        Args:
            show: whether the page shall show the list.
        """
        before, entries = self.listing, self._library.listing()
        known = ((entry.label, before.about.get(entry.label)) for entry in entries)
        about = {label: found for label, found in known if found}
        self.listing = Listing(entries, about, before.looks + 1, before.shown + show)
        self._catalogue.request(self, entries, self._notify)

    def prefer(self, rows: Sequence[int]) -> None:
        """Find out about the recordings at these places of the list first."""
        entries = self.listing.entries
        labels = [entries[row].label for row in rows if 0 <= row < len(entries)]
        self._catalogue.prefer(self, labels)

    def receive(self, found: Mapping[str, About]) -> None:
        """Take over what was found."""
        self.listing = replace(self.listing, about={**self.listing.about, **found})

    def leave(self) -> None:
        """Find out nothing more, until the next look."""
        self._catalogue.cancel(self)

    def neighbours(self, opened: Opened | None, steps: int) -> list[str]:
        """Labels of recordings that follow the open one, as far as they may open; nearest first.

        Args:
            opened: the open recording, None without one.
            steps: how many to go, backwards where negative; the nearer ones are left out.
        """
        listed = self._library.listing()
        self.listing = replace(self.listing, entries=listed)
        entries = [entry for entry in listed if not self._unreadable(entry)]
        if steps < 0:
            entries.reverse()
        places = [i for i, entry in enumerate(entries) if opened and entry == opened.entry]
        begin = places[0] if places else -1
        following = [entry.label for entry in entries[begin + 1 :]]
        return following[min(abs(steps), len(following)) - 1 :] if following else []

    def _unreadable(self, entry: Entry) -> bool:
        return isinstance(self._catalogue.known(entry), Unreadable)
