"""True motion of long recordings, read in a background thread."""

import logging
import threading
import time
from collections.abc import Callable, Hashable
from dataclasses import dataclass

from app.analysis.estimates import Estimates
from app.analysis.library import Opened
from app.analysis.pairs import moves
from app.errors import UserError

_LOG = logging.getLogger(__name__)
_QUIET = 0.1  # seconds without foreground work before the next piece
_PATIENCE = 0.5  # seconds after which it is read in any case, since playing never pauses
_PIECE = 0.02  # seconds that a piece takes, during which sliders share the interpreter with it
_NOTIFY_INTERVAL = 1.0  # seconds, as a timeline is rebuilt no more often


@dataclass
class _Request:
    """A requested recording; `wanted` until it is withdrawn, after which the file may close."""

    opened: Opened
    notify: Callable[[], None]
    wanted: bool = True
    notified: float = float("-inf")


class TrueMotions:
    """Fills the timelines of all sessions' recordings with the true motion, in turn.

    Args:
        estimates: holds the timelines.
    """

    def __init__(self, estimates: Estimates) -> None:
        self._estimates = estimates
        self._changed = threading.Lock()
        self._requests: dict[Hashable, _Request] = {}
        self._thread: threading.Thread | None = None

    def request(self, owner: Hashable, opened: Opened, notify: Callable[[], None]) -> None:
        """Have a recording's true motion read, in place of the owner's earlier request.

        Args:
            owner: of the request; has one at a time.
            opened: must stay open until the owner's next request or `cancel`.
            notify: called by the background thread, repeatedly and when all is read; must not
                block.
        """
        timeline = self._estimates.recorded_timeline(opened)
        with self._changed:
            self._withdraw(owner)
            if timeline.complete:
                return
            self._requests[owner] = _Request(opened, notify)
            if self._thread is None:
                self._thread = threading.Thread(target=self._run, name="truth", daemon=True)
                self._thread.start()

    def cancel(self, owner: Hashable) -> None:
        """Cancel the owner's request; its recording may then be closed."""
        with self._changed:
            self._withdraw(owner)

    def _withdraw(self, owner: Hashable) -> None:
        if request := self._requests.pop(owner, None):
            request.wanted = False

    def _run(self) -> None:
        while True:
            with self._changed:
                if not self._requests:
                    self._thread = None  # the next request starts another
                    return
                turn = list(self._requests.items())
            for owner, request in turn:
                self._estimates.foreground.wait_until_quiet(_QUIET, _PATIENCE)
                try:
                    ended = self._read_on(request)
                except Exception:
                    if request.wanted:  # else its file may have been closed meanwhile
                        _LOG.exception(
                            "%s: its truth cannot be read", request.opened.recording.name
                        )
                    ended = True
                if ended:
                    with self._changed:
                        if self._requests.get(owner) is request:
                            del self._requests[owner]

    def _read_on(self, request: _Request) -> bool:
        """Read a piece, and return whether the request is finished."""
        timeline = self._estimates.recorded_timeline(request.opened)
        moving: list[bool] = []
        end = time.monotonic() + _PIECE
        for k in range(timeline.read, timeline.count):
            moving.append(_moves(request.opened, k))
            if time.monotonic() > end:
                break
        with self._changed:
            if not request.wanted:
                return True  # a file that was closed meanwhile says nothing of motion
            timeline.add(moving)
        now = time.monotonic()
        if timeline.complete or now - request.notified > _NOTIFY_INTERVAL:
            request.notified = now
            request.notify()
        return timeline.complete


def _moves(opened: Opened, k: int) -> bool:
    """Whether the object truly moves at a frame; a broken one has no motion."""
    try:
        return moves(opened.recording, k)
    except UserError:
        return False
