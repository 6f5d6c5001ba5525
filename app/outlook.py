"""What one session sees of the timeline."""

import time

from app.estimates import Estimates
from app.library import Opened
from app.timeline import Timeline
from estimator import Parameters

_AGE = 1.0  # seconds after which it is looked through again


class Outlook:
    """A look at the timeline, again once in a while: estimates come one by one.

    Args:
        estimates: that are known.
    """

    def __init__(self, estimates: Estimates) -> None:
        self._estimates = estimates
        self._last: tuple[tuple[Opened, Parameters], float, Timeline] | None = None

    def timeline(self, opened: Opened, parameters: Parameters) -> Timeline:
        """The recording at a glance."""
        wanted, now = (opened, parameters), time.monotonic()
        if self._last is None or self._last[0] != wanted or now > self._last[1] + _AGE:
            self._last = (wanted, now, self._estimates.timeline(opened, parameters))
        return self._last[2]
