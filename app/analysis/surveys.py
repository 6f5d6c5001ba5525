"""Surveys of whole recordings, computed in a background thread."""

import logging
import os
import time
from collections.abc import Callable, Hashable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from itertools import islice

from app.analysis.cache import Cache
from app.analysis.estimates import Estimates
from app.analysis.kept_rounds import KeptRounds, without_thresholds
from app.analysis.library import Opened
from app.analysis.pairs import Pair
from app.analysis.survey import Survey
from app.analysis.survey_order import survey_order
from app.analysis.turns import Turns
from app.errors import UserError
from estimator import Engine, Parameters, current_engine

_CORES = os.cpu_count() or 1  # the compiled engine works without the interpreter's lock
_AT_ONCE = 4 * _CORES  # pairs between two looks for foreground work, while there is none
_MOST_FRAMES = 2**16  # of all cached surveys together, some 350 bytes each
_SHORT = 1000  # frames up to which what is known is filled in while a person waits
_BLOCK = 32  # pairs whose rounds are kept together, while the estimates' caches hold them
_KEPT = 4  # recordings, or settings of one, whose rounds are kept
_LOG = logging.getLogger(__name__)
_QUIET = (
    0.2  # seconds without foreground work before the next pairs, so that sliders stay responsive
)
_PATIENCE = 2.0  # seconds after which each survey advances by one frame in any case
_NOTIFY_INTERVAL = 0.3  # minimum seconds between two notifications


@dataclass
class _Request:
    """A requested survey.

    Attributes:
        wanted: no more notifications once this is false.
        filled: whether what is known without an estimate was filled in.
        unkept: frames whose rounds are to be kept next.
        searched: whether frames whose rounds are missing were searched for.
    """

    opened: Opened
    parameters: Parameters
    survey: Survey
    notify: Callable[[Survey], None]
    near: int
    wanted: bool = True
    filled: bool = False
    notified: float = field(default=float("-inf"))
    failed: bool = False
    unkept: list[int] = field(default_factory=list[int])
    searched: bool = False
    engine: Engine = field(default_factory=current_engine)
    _order: Iterator[int] | None = None

    @property
    def goes_on(self) -> bool:
        """Whether it is wanted, and estimates are still made by the engine of its survey."""
        return self.wanted and self.engine is current_engine()

    def next_frames(self, most: int) -> list[int]:
        """Next frames to compute, at most so many; none once all are done."""
        if self._order is None:
            self._order = iter(survey_order(len(self.survey), self.near))
        return list(islice((k for k in self._order if not self.survey.done[k]), most))


class Surveys:
    """Fills the surveys of all sessions in the background, a pair a core of each in turn.

    Args:
        estimates: computes and caches the pairs.
        size: maximum number of cached surveys.
    """

    def __init__(self, estimates: Estimates, size: int = 16) -> None:
        self._estimates = estimates
        self._surveys: Cache[tuple, Survey] = Cache(size, len, _MOST_FRAMES)
        self._kept: Cache[tuple, KeptRounds] = Cache(_KEPT, len, _MOST_FRAMES)
        # Not a daemon: it must not be cut off inside of Open3D when the program ends.
        self._turns: Turns[_Request] = Turns(
            "surveys", self._step, lambda _: "A survey could not go on.", daemon=False
        )
        self._pool = ThreadPoolExecutor(_CORES, thread_name_prefix="survey")

    def request(
        self,
        owner: Hashable,
        opened: Opened,
        parameters: Parameters,
        notify: Callable[[Survey], None],
        near: int = 0,
    ) -> Survey:
        """Request a survey, in place of the owner's earlier one.

        Args:
            owner: of the request; has one at a time.
            opened: must stay open until the owner's next request or `cancel`.
            parameters: of the estimates.
            notify: called with the survey by the background thread, repeatedly and when it is
                complete; must not block.
            near: the frame that is looked at; it and its neighbours come first.

        Returns:
            The survey, with what is known already; where all is, `notify` is not called.
        """
        self.cancel(owner)
        survey = self._surveys.get(
            (opened.key, current_engine().name, parameters),
            lambda: Survey(opened.recording, parameters),
        )
        request = _Request(opened, parameters, survey, notify, near)
        if len(survey) <= _SHORT:
            self._fill_from_known(request)
        kept = self._kept_rounds(opened, parameters)
        if survey.complete and (kept is None or not kept.missing()):
            return survey
        self._turns.add(owner, request)
        return survey

    @property
    def idle(self) -> bool:
        """Whether nothing is left to do."""
        return self._turns.idle

    def known(self, opened: Opened, parameters: Parameters) -> Survey | None:
        """The survey as far as it is filled, None if it is not cached."""
        return self._surveys.known((opened.key, current_engine().name, parameters))

    def cancel(self, owner: Hashable) -> None:
        """Cancel the owner's request."""
        self._turns.cancel(owner)

    def _step(self, request: _Request, among: int) -> bool:
        """Go on with a request once nobody waits, and return whether it is finished."""
        quiet = self._estimates.foreground.wait_until_quiet(_QUIET, _PATIENCE / among)
        return not request.goes_on or self._advance(request, _AT_ONCE if quiet else 1)

    def _fill_from_known(self, request: _Request) -> None:
        """Fill in what is known without an estimate."""
        request.filled = True
        survey, opened, parameters = request.survey, request.opened, request.parameters
        if (kept := self._kept_rounds(opened, parameters)) is not None:
            kept.fill(survey)
        for known in self._estimates.cached(opened, parameters):
            if not survey.done[known.frame]:  # already computed by playing or scrubbing
                survey.put(known.frame, known)

    def _kept_rounds(self, opened: Opened, parameters: Parameters) -> KeptRounds | None:
        settings = without_thresholds(parameters)
        if settings is None:
            return None
        return self._kept.get(
            (opened.key, current_engine().name, settings),
            lambda: KeptRounds(opened.recording, settings),
        )

    def _advance(self, request: _Request, most: int) -> bool:
        """Fill in some frames, or keep their rounds, and return whether the request is finished."""
        if not request.filled:
            self._fill_from_known(request)
            self._tell(request)
        kept = self._kept_rounds(request.opened, request.parameters)
        frames = [] if len(request.unkept) >= _BLOCK else request.next_frames(most)
        if frames:
            self._fill(request, frames)
            if kept is not None:
                request.unkept += [k for k in frames if kept.wants(k)]
        elif kept is not None:
            if not (request.unkept or request.searched):
                # Of pairs that were known before, as by playing, no rounds are kept yet.
                request.searched, request.unkept = True, kept.missing()
            self._keep(request, kept, most)
        left = frames or request.unkept or (kept is not None and not request.searched)
        return not (request.goes_on and left)

    def _fill(self, request: _Request, frames: list[int]) -> None:
        survey = request.survey
        for k, pair in zip(
            frames, self._pool.map(lambda k: self._pair(request, k), frames), strict=True
        ):
            if not request.goes_on:
                return  # its recording may have been closed meanwhile
            survey.put(k, pair)
        self._tell(request)

    def _tell(self, request: _Request) -> None:
        """Notify whoever asked, unless that was done shortly before and there is more to come."""
        survey, now = request.survey, time.monotonic()
        if survey.complete or now - request.notified > max(_NOTIFY_INTERVAL, len(survey) * 2e-4):
            request.notified = now
            request.notify(survey)

    def _keep(self, request: _Request, kept: KeptRounds, most: int) -> None:
        frames, request.unkept = request.unkept[:most], request.unkept[most:]

        def keep(k: int) -> None:
            pair = self._pair(request, k)
            if not request.goes_on:
                return
            if pair is None or pair.flow is None:
                kept.leave_out(k)
                return
            clusters = self._estimates.all_rounds(request.opened, k, request.parameters)
            if request.goes_on:
                kept.put(pair, clusters, request.survey)

        list(self._pool.map(keep, frames))

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
