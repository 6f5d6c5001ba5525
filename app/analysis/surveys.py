"""Surveys of whole recordings, computed in a background thread."""

import logging
import os
import threading
import time
from collections.abc import Callable, Hashable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field

from app.analysis.cache import Cache
from app.analysis.estimates import Estimates
from app.analysis.library import Opened
from app.analysis.pairs import Pair
from app.analysis.survey import Survey
from app.errors import UserError
from estimator import Parameters, current_engine

_CORES = os.cpu_count() or 1  # the compiled engine works without the interpreter's lock
_LOG = logging.getLogger(__name__)
_QUIET = (
    0.2  # seconds without foreground work before the next pairs, so that sliders stay responsive
)
_PATIENCE = 2.0  # seconds after which each survey advances by one frame in any case
_NOTIFY_INTERVAL = 0.3  # minimum seconds between two notifications


@dataclass
class _Request:
    """A requested survey; no more notifications once `wanted` is false."""

    opened: Opened
    parameters: Parameters
    notify: Callable[[Survey], None]
    wanted: bool = True
    notified: float = field(default=float("-inf"))
    survey: Survey | None = None
    failed: bool = False


class Surveys:
    """Fills the surveys of all sessions in the background, a pair a core of each in turn.

    Args:
        estimates: computes and caches the pairs.
        size: maximum number of cached surveys.
    """

    def __init__(self, estimates: Estimates, size: int = 16) -> None:
        self._estimates = estimates
        self._surveys: Cache[tuple, Survey] = Cache(size)
        self._changed = threading.Condition()
        self._requests: dict[Hashable, _Request] = {}
        self._thread: threading.Thread | None = None
        self._pool = ThreadPoolExecutor(_CORES, thread_name_prefix="survey")

    def request(
        self,
        owner: Hashable,
        opened: Opened,
        parameters: Parameters,
        notify: Callable[[Survey], None],
    ) -> None:
        """Request a survey, in place of the owner's earlier one.

        Args:
            owner: of the request; has one at a time.
            opened: must stay open until the owner's next request or `cancel`.
            parameters: of the estimates.
            notify: called with the survey by the background thread, repeatedly and when it is
                complete; must not block.
        """
        with self._changed:
            self._withdraw(owner)
            self._requests[owner] = _Request(opened, parameters, notify)
            if self._thread is None:
                # Not a daemon: it must not be cut off inside of Open3D when the program ends.
                self._thread = threading.Thread(target=self._run, name="surveys")
                self._thread.start()

    def known(self, opened: Opened, parameters: Parameters) -> Survey | None:
        """The survey as far as it is filled, None if it is not cached."""
        return self._surveys.known((opened.key, current_engine().name, parameters))

    def cancel(self, owner: Hashable) -> None:
        """Cancel the owner's request."""
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
                self._estimates.foreground.wait_until_quiet(_QUIET, _PATIENCE / len(turn))
                try:
                    if request.wanted and self._advance(request):
                        self._finish(owner, request)
                except Exception:
                    _LOG.exception("A survey could not go on.")
                    self._finish(owner, request)

    def _finish(self, owner: Hashable, request: _Request) -> None:
        with self._changed:
            if self._requests.get(owner) is request:
                del self._requests[owner]

    def _advance(self, request: _Request) -> bool:
        """Fill in a frame a core, and return whether the request is finished."""
        opened, parameters = request.opened, request.parameters
        survey = request.survey = request.survey or self._surveys.get(
            (opened.key, current_engine().name, parameters),
            lambda: Survey(opened.recording, parameters),
        )
        for known in self._estimates.cached(opened, parameters):
            if not survey.done[known.frame]:  # already computed by playing or scrubbing
                survey.put(known.frame, known)
        frames = survey.missing(_CORES)
        pairs = list(self._pool.map(lambda k: self._pair(request, k), frames))
        if not request.wanted:
            return True  # its recording may have been closed meanwhile
        for k, pair in zip(frames, pairs, strict=True):
            survey.put(k, pair)
        now = time.monotonic()
        if survey.complete or now - request.notified > max(_NOTIFY_INTERVAL, len(survey) * 2e-4):
            request.notified = now
            request.notify(survey)
        return survey.complete

    def _pair(self, request: _Request, k: int) -> Pair | None:
        try:
            return self._estimates.estimated_in_background(request.opened, k, request.parameters)
        except UserError:
            return None  # reported when the frame is shown
        except Exception:
            if request.wanted and not request.failed:
                request.failed = True  # logged once, and not for every frame
                _LOG.exception("Frame %d of a survey failed.", k)
            return None
