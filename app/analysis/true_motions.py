"""True motion of long recordings, read in a background thread."""

import time
from collections.abc import Callable, Hashable
from dataclasses import dataclass

from app.analysis.estimates import Estimates
from app.analysis.library import Opened
from app.analysis.pairs import moves
from app.analysis.turns import Turns
from app.errors import UserError

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
        self._turns: Turns[_Request] = Turns(
            "truth",
            self._step,
            lambda request: f"{request.opened.recording.name}: its truth cannot be read",
            daemon=True,
        )

    @property
    def idle(self) -> bool:
        """Whether nothing is left to do."""
        return self._turns.idle

    def request(self, owner: Hashable, opened: Opened, notify: Callable[[], None]) -> None:
        """Have a recording's true motion read, in place of the owner's earlier request.

        Args:
            owner: of the request; has one at a time.
            opened: must stay open until the owner's next request or `cancel`.
            notify: called by the background thread, repeatedly and when all is read; must not
                block.
        """
        self.cancel(owner)
        if not self._estimates.recorded_timeline(opened).complete:
            self._turns.add(owner, _Request(opened, notify))

    def cancel(self, owner: Hashable) -> None:
        """Cancel the owner's request; its recording may then be closed."""
        self._turns.cancel(owner)

    def _step(self, request: _Request, among: int) -> bool:
        """Read on once nobody waits, and return whether the request is finished."""
        del among
        self._estimates.foreground.wait_until_quiet(_QUIET, _PATIENCE)
        return self._read_on(request)

    def _read_on(self, request: _Request) -> bool:
        """Read a piece, and return whether the request is finished."""
        timeline = self._estimates.recorded_timeline(request.opened)
        moving: list[bool] = []
        end = time.monotonic() + _PIECE
        for k in range(timeline.read, timeline.count):
            moving.append(_moves(request.opened, k))
            if time.monotonic() > end:
                break
        with self._turns.changed:
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
