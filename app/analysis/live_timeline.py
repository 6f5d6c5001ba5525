"""Timeline of what one session shows, as far as it is known by now."""

import time

from app.analysis.estimates import Estimates
from app.analysis.library import Opened
from app.analysis.survey import Survey
from app.analysis.surveys import Surveys
from app.analysis.timeline import Timeline
from estimator import Parameters

_AGE = 1.0  # seconds after which it is looked through again


class LiveTimeline:
    """Timeline that is looked through again once in a while: estimates come one by one.

    Args:
        estimates: that are known, of a bounded number of frames.
        surveys: that are known, of all frames of a recording.
    """

    def __init__(self, estimates: Estimates, surveys: Surveys) -> None:
        self._estimates = estimates
        self._surveys = surveys
        self._survey: Survey | None = None
        self._last: tuple[tuple[Opened, Parameters], float, Timeline] | None = None

    def of(self, opened: Opened, parameters: Parameters) -> Timeline:
        """The recording at a glance; where there is no truth, what is estimated says it."""
        wanted, now = (opened, parameters), time.monotonic()
        fresh = self._last is None or self._last[0] != wanted
        if fresh:
            self._survey = None
        if self._last is None or fresh or now > self._last[1] + _AGE:
            # A survey that was found is held: many others may be asked for meanwhile.
            self._survey = self._survey or self._surveys.known(opened, parameters)
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
