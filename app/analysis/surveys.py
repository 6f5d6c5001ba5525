"""Surveys of whole recordings, filled in the background while people do something else."""

import logging
import threading
import time
from collections.abc import Callable, Hashable
from dataclasses import dataclass, field

from app.analysis.cache import Cache
from app.analysis.estimates import Estimates
from app.analysis.library import Opened
from app.analysis.pairs import Pair
from app.analysis.survey import Survey
from app.errors import UserError
from estimator import Parameters

_LOG = logging.getLogger(__name__)
_QUIET = 0.6  # seconds without anybody waiting for an estimate; who tunes is hardly held up
_PATIENCE = 2.0  # seconds after which each survey goes on by one frame all the same
_TELL = 0.3  # seconds between two times that a listener is told of something new


@dataclass
class _Request:
    """What somebody wants to know; nothing of it is told once `wanted` is false."""

    opened: Opened
    parameters: Parameters
    tell: Callable[[Survey], None]
    wanted: bool = True
    told: float = field(default=float("-inf"))
    survey: Survey | None = None


class Surveys:
    """Fills surveys in one thread for all sessions, a pair for each of them in turn.

    Args:
        estimates: computes the pairs, and remembers them for whoever looks at them next.
        remembered: how many surveys are remembered.
    """

    def __init__(self, estimates: Estimates, remembered: int = 16) -> None:
        self._estimates = estimates
        self._surveys: Cache[tuple, Survey] = Cache(remembered)
        self._changed = threading.Condition()
        self._requests: dict[Hashable, _Request] = {}
        self._thread: threading.Thread | None = None

    def ask(
        self,
        who: Hashable,
        opened: Opened,
        parameters: Parameters,
        tell: Callable[[Survey], None],
    ) -> None:
        """Ask for a survey instead of the one that `who` asked for before.

        Args:
            who: asks for one at a time.
            opened: stays open until `who` asks for another or leaves.
            parameters: of the estimates.
            tell: is called with the survey by the background's thread, when something of it is
                new and at last when it is complete; it must not wait.
        """
        with self._changed:
            self._withdraw(who)
            self._requests[who] = _Request(opened, parameters, tell)
            if self._thread is None:
                # Not a daemon: it must not be cut off inside of Open3D when the program ends.
                self._thread = threading.Thread(target=self._run, name="surveys")
                self._thread.start()

    def known(self, opened: Opened, parameters: Parameters) -> Survey | None:
        """A survey as far as it is filled, None where nothing of it is remembered."""
        return self._surveys.known((opened.key, parameters))

    def leave(self, who: Hashable) -> None:
        """Ask for nothing any more."""
        with self._changed:
            self._withdraw(who)

    def _withdraw(self, who: Hashable) -> None:
        if request := self._requests.pop(who, None):
            request.wanted = False

    def _run(self) -> None:
        while True:
            with self._changed:
                if not self._requests:
                    self._thread = None  # the next who asks starts another
                    return
                turn = list(self._requests.items())
            for who, request in turn:
                self._estimates.foreground.wait_until_quiet(_QUIET, _PATIENCE / len(turn))
                try:
                    if request.wanted and self._advance(request):
                        self._finish(who, request)
                except Exception:
                    _LOG.exception("A survey could not go on.")
                    self._finish(who, request)

    def _finish(self, who: Hashable, request: _Request) -> None:
        with self._changed:
            if self._requests.get(who) is request:
                del self._requests[who]

    def _advance(self, request: _Request) -> bool:
        """Fill in one frame; whether there is nothing left to do."""
        opened, parameters = request.opened, request.parameters
        survey = request.survey = request.survey or self._surveys.get(
            (opened.key, parameters), lambda: Survey(opened.recording, parameters)
        )
        for known in self._estimates.cached(opened, parameters):
            if not survey.done[known.frame]:  # who plays or scrubs has computed it already
                survey.put(known.frame, known)
        k = survey.missing()
        if k is not None:
            pair = self._pair(request, k)
            if not request.wanted:
                return True  # its recording may have been closed meanwhile
            survey.put(k, pair)
        now = time.monotonic()
        if survey.complete or now - request.told > max(_TELL, len(survey) * 2e-4):
            request.told = now
            request.tell(survey)
        return survey.complete

    def _pair(self, request: _Request, k: int) -> Pair | None:
        try:
            return self._estimates.estimated_in_background(request.opened, k, request.parameters)
        except UserError:
            return None  # whoever goes to this frame is told why
        except Exception:
            if request.wanted:
                raise
            return None
