"""A background thread that works on the requests of several owners in turn."""

import logging
import threading
from collections.abc import Callable, Hashable
from typing import Generic, Protocol, TypeVar

_LOG = logging.getLogger(__name__)


class Request(Protocol):
    """What an owner asks for; `wanted` until it is withdrawn."""

    wanted: bool


R = TypeVar("R", bound=Request)


class Turns(Generic[R]):
    """Works on requests, one of each owner, a step of each in turn; the thread ends without any.

    Args:
        name: of the thread.
        step: takes a request and the number of those in turn, and returns whether it is finished.
            An error finishes it, and is logged unless the request was withdrawn meanwhile.
        failure: what the log says of a request's error.
        daemon: whether the thread may be cut off when the program ends.
    """

    def __init__(
        self,
        name: str,
        step: Callable[[R, int], bool],
        failure: Callable[[R], str],
        *,
        daemon: bool,
    ) -> None:
        self._name, self._daemon = name, daemon
        self._step, self._failure = step, failure
        self.changed = threading.RLock()
        """Held while requests are added or withdrawn."""
        self._requests: dict[Hashable, R] = {}
        self._thread: threading.Thread | None = None

    @property
    def idle(self) -> bool:
        """Whether nothing is left to do."""
        return self._thread is None

    def add(self, owner: Hashable, request: R) -> None:
        """Work on a request, in place of the owner's earlier one."""
        with self.changed:
            self.cancel(owner)
            self._requests[owner] = request
            if self._thread is None:
                self._thread = threading.Thread(
                    target=self._run, name=self._name, daemon=self._daemon
                )
                self._thread.start()

    def cancel(self, owner: Hashable) -> None:
        """Withdraw the owner's request, if there is one."""
        with self.changed:
            if request := self._requests.pop(owner, None):
                request.wanted = False

    def _run(self) -> None:
        while True:
            with self.changed:
                if not self._requests:
                    self._thread = None  # the next request starts another
                    return
                turn = list(self._requests.items())
            for owner, request in turn:
                if self._finished(request, len(turn)):
                    with self.changed:
                        if self._requests.get(owner) is request:
                            del self._requests[owner]

    def _finished(self, request: R, among: int) -> bool:
        try:
            return self._step(request, among)
        except Exception:
            if request.wanted:  # else its recording may have been closed meanwhile
                _LOG.exception("%s", self._failure(request))
            return True
