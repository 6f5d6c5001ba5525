"""Timeline of a session's recording, refreshed while estimates arrive."""

import time
from collections.abc import Callable

import numpy as np

from app.analysis.estimates import Estimates
from app.analysis.library import Opened
from app.analysis.survey import Survey
from app.analysis.surveys import Surveys
from app.analysis.timeline import Timeline
from app.analysis.true_motions import TrueMotions
from estimator import Parameters

_AGE = 1.0  # seconds after which a timeline is rebuilt


class LiveTimeline:
    """Timeline of one recording at a time, rebuilt at most once a second, and when all is known.

    Args:
        estimates: cache of a bounded number of frames.
        surveys: cache of numbers of all frames.
        motions: reads the true motion of long recordings.
        notify: called by a background thread when more of it is known; must not block.
    """

    def __init__(
        self,
        estimates: Estimates,
        surveys: Surveys,
        motions: TrueMotions,
        notify: Callable[[], None],
    ) -> None:
        self._estimates = estimates
        self._surveys = surveys
        self._motions, self._notify = motions, notify
        self._survey: Survey | None = None
        self._known = (False, False)
        self._last: tuple[tuple[Opened, Parameters], float, Timeline] | None = None

    def of(self, opened: Opened, parameters: Parameters) -> Timeline:
        """The timeline of a recording; motion comes from the estimates if there is no truth.

        Args:
            opened: must stay open until the next `of` or `stop`.
            parameters: of the estimates.
        """
        wanted, now = (opened, parameters), time.monotonic()
        fresh = self._last is None or self._last[0] != wanted
        if self._last is None or self._last[0][0] != opened:
            self._motions.request(self, opened, self._notify)
        if fresh:
            self._survey = None
        # Held here, since the cache of surveys may drop it.
        self._survey = self._survey or self._surveys.known(opened, parameters)
        recorded = self._estimates.recorded_timeline(opened)
        known = (self._survey is not None and self._survey.complete, recorded.complete)
        # At once after the last numbers and the last truth, since nothing may ask again.
        if self._last is None or fresh or known != self._known or now > self._last[1] + _AGE:
            self._known = known
            self._last = (wanted, now, self._look(opened, parameters))
        return self._last[2]

    def stop(self) -> None:
        """Leave the recording, which may then be closed."""
        self._motions.cancel(self)
        self._last = None

    def _look(self, opened: Opened, parameters: Parameters) -> Timeline:
        recorded, survey = self._estimates.recorded_timeline(opened), self._survey
        empty, moving = np.zeros(recorded.count, dtype=bool), np.zeros(recorded.count, dtype=bool)
        if survey is not None:
            empty, moving = survey.empty.copy(), survey.moving > 0
        for pair in self._estimates.cached(opened, parameters):
            empty[pair.frame] = len(pair.target.points) == 0
            moving[pair.frame] = pair.anything_moves
        return recorded.with_estimates(empty, moving)
