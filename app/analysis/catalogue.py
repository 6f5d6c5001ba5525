"""Catalogue of the listed recordings: what is in each, found out in the background."""

import logging
import threading
import time
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from app.analysis.cache import Cache
from app.analysis.foreground import Foreground
from app.analysis.library import Entry, Library
from app.errors import UserError
from recordings import Recording

_LOG = logging.getLogger(__name__)
_QUIET, _PATIENCE = 0.3, 1.0
"""Seconds without foreground work before the next file is opened, and after which it is anyway."""
_NOTIFY_INTERVAL = 0.3  # minimum seconds between two notifications


@dataclass(frozen=True)
class Facts:
    """What is in a recording.

    Attributes:
        simulated: whether it is no measurement.
        scenario: of a simulation, with speed and trial; empty where it has none.
        seconds: from the first frame to the last.
        frames: number of them.
        sensors: number of them.
        truth: whether the motion of the moving object is known.
    """

    simulated: bool
    scenario: str
    seconds: float
    frames: int
    sensors: int
    truth: bool


@dataclass(frozen=True)
class Unreadable:
    """A file that cannot be opened.

    Attributes:
        reason: in a sentence.
    """

    reason: str


About = Facts | Unreadable
Notify = Callable[[Mapping[str, About]], None]


def facts_of(recording: Recording) -> Facts:
    """What is in an open recording."""
    provenance = recording.provenance
    return Facts(
        simulated=recording.simulated,
        scenario=provenance.experiment if provenance and recording.simulated else "",
        seconds=float(recording.stamps[-1] - recording.stamps[0]) if len(recording) else 0.0,
        frames=len(recording),
        sensors=len(recording.sensors),
        truth=recording.has_truth,
    )


@dataclass
class _Request:
    pending: dict[str, Entry]
    notify: Notify
    preferred: Sequence[str] = ()
    found: dict[str, About] = field(default_factory=dict)
    notified: float = float("-inf")

    def next(self) -> Entry | None:
        """The entry to look at next."""
        wanted = next((label for label in self.preferred if label in self.pending), None)
        label = wanted if wanted is not None else next(iter(self.pending), None)
        return None if label is None else self.pending[label]


class Catalogue:
    """Opens the files that sessions ask about, one after the other in one thread.

    What is known of a file is kept until it changes.

    Args:
        library: opens the files, and shares those that are open.
        foreground: work of all sessions that goes first.
        size: number of files that are remembered.
    """

    def __init__(self, library: Library, foreground: Foreground, size: int = 5000) -> None:
        self._library, self._foreground = library, foreground
        self._about: Cache[tuple[str, int, int], About] = Cache(size)
        self._lock = threading.Lock()
        self._requests: dict[Hashable, _Request] = {}
        self._thread: threading.Thread | None = None

    def request(self, owner: Hashable, entries: Iterable[Entry], notify: Notify) -> None:
        """Ask about recordings, in place of the owner's earlier request.

        Args:
            owner: of the request; has one at a time.
            entries: in the order in which they are opened.
            notify: called with {label: what was found} by the background thread, repeatedly; must
                not block.
        """
        with self._lock:
            self._requests[owner] = _Request({entry.label: entry for entry in entries}, notify)
            if self._thread is None:
                # Not a daemon: files are closed before the program ends.
                self._thread = threading.Thread(target=self._run, name="catalogue")
                self._thread.start()

    def prefer(self, owner: Hashable, labels: Sequence[str]) -> None:
        """Open those of these labels first that the owner has asked about."""
        with self._lock:
            if request := self._requests.get(owner):
                request.preferred = labels

    def cancel(self, owner: Hashable) -> None:
        """Forget the owner's request."""
        with self._lock:
            self._requests.pop(owner, None)

    def known(self, entry: Entry) -> About | None:
        """What is known of a recording as its file is now, None without; opens nothing."""
        key = _key(entry)
        return self._about.known(key) if key else None

    def _run(self) -> None:
        while turn := self._next_turn():
            for owner, request in turn:
                self._advance(owner, request)

    def _next_turn(self) -> list[tuple[Hashable, _Request]]:
        with self._lock:
            if not self._requests:
                self._thread = None  # the next request starts another
            return list(self._requests.items())

    def _advance(self, owner: Hashable, request: _Request) -> None:
        """Look at the next entry of a request, and at all that need not be opened."""
        while (entry := self._entry(request)) and (known := self.known(entry)):
            self._found(request, entry, known)
        if entry is not None:
            self._foreground.wait_until_quiet(_QUIET, _PATIENCE)
            if self._wanted(owner, request):
                self._found(request, entry, self._look(entry))
        now, complete = time.monotonic(), not request.pending
        if complete or now - request.notified > _NOTIFY_INTERVAL:
            request.notified = now
            found, request.found = request.found, {}
            if self._wanted(owner, request):
                request.notify(found)
        if complete and self._wanted(owner, request):
            self.cancel(owner)

    def _entry(self, request: _Request) -> Entry | None:
        with self._lock:
            return request.next()

    def _wanted(self, owner: Hashable, request: _Request) -> bool:
        with self._lock:
            return self._requests.get(owner) is request

    def _found(self, request: _Request, entry: Entry, about: About) -> None:
        with self._lock:
            del request.pending[entry.label]
            request.found[entry.label] = about

    def _look(self, entry: Entry) -> About:
        key = _key(entry)
        return self._about.get(key, lambda: self._opened(entry)) if key else self._opened(entry)

    def _opened(self, entry: Entry) -> About:
        try:
            opened = self._library.open(entry)
        except UserError as error:
            return Unreadable(without_path(str(error), entry))
        except Exception as error:
            _LOG.exception("%s could not be looked at.", entry.path)
            return Unreadable(f"It cannot be opened ({type(error).__name__}: {error}).")
        try:
            return facts_of(opened.recording)
        finally:
            self._library.release(entry)


def without_path(sentence: str, entry: Entry) -> str:
    """A sentence about a file, to stand beside its name."""
    path = str(entry.path)
    if sentence.startswith(f"{path} "):
        sentence = f"It{sentence.removeprefix(path)}"
    elif sentence.startswith(f"{path}: "):
        rest = sentence.removeprefix(f"{path}: ")
        sentence = rest[:1].upper() + rest[1:]
    return sentence.replace(path, entry.path.name)


def _key(entry: Entry) -> tuple[str, int, int] | None:
    try:
        status = entry.path.stat()
    except OSError:
        return None
    return str(entry.path), status.st_size, status.st_mtime_ns
