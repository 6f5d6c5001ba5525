"""Timeline of a session's recording, refreshed while estimates arrive."""

import time

from app.analysis.estimates import Estimates
from app.analysis.library import Opened
from app.analysis.survey import Survey
from app.analysis.surveys import Surveys
from app.analysis.timeline import Timeline
from estimator import Parameters

_AGE = 1.0  # seconds after which a timeline is rebuilt


class LiveTimeline:
    """Timeline of one recording at a time, rebuilt at most once a second, and when all is known.

    Args:
        estimates: cache of a bounded number of frames.
        surveys: cache of numbers of all frames.
    """

    def __init__(self, estimates: Estimates, surveys: Surveys) -> None:
        self._estimates = estimates
        self._surveys = surveys
        self._survey: Survey | None = None
        self._complete = False
        self._last: tuple[tuple[Opened, Parameters], float, Timeline] | None = None

    def of(self, opened: Opened, parameters: Parameters) -> Timeline:
        """The timeline of a recording; motion comes from the estimates if there is no truth."""
        wanted, now = (opened, parameters), time.monotonic()
        fresh = self._last is None or self._last[0] != wanted
        if fresh:
            self._survey = None
        # Held here, since the cache of surveys may drop it.
        self._survey = self._survey or self._surveys.known(opened, parameters)
        complete = self._survey is not None and self._survey.complete
        # At once after a survey's last numbers, since nothing may ask again.
        ended = complete and not self._complete
        if self._last is None or fresh or ended or now > self._last[1] + _AGE:
            self._complete = complete
            self._last = (wanted, now, self._look(opened, parameters))
        return self._last[2]

    def _look(self, opened: Opened, parameters: Parameters) -> Timeline:
        recorded, survey = self._estimates.recorded_timeline(opened), self._survey
        empty, moving = [False] * recorded.count, [False] * recorded.count
        if survey is not None:
            empty, moving = survey.empty.tolist(), (survey.moving > 0).tolist()
        for pair in self._estimates.cached(opened, parameters):
            empty[pair.frame] = len(pair.target.points) == 0
            moving[pair.frame] = pair.anything_moves
        return recorded.with_estimates(empty, moving)
