"""Survey of a session's recording, followed while the background fills it."""

from collections.abc import Callable
from dataclasses import dataclass

from app.analysis.library import Opened
from app.analysis.survey import Survey
from app.analysis.surveys import Surveys
from estimator import Engine, Parameters, current_engine


@dataclass(frozen=True)
class SurveyUpdate:
    """Progress of a survey.

    Attributes:
        requested: recording, parameters and engine of the request.
        survey: as far as it is filled.
    """

    requested: tuple[Opened, Parameters, Engine]
    survey: Survey


class FollowedSurvey:
    """Requests one survey at a time; used by the session's thread alone.

    Args:
        surveys: computes whole recordings in the background.
        notify: called with updates by the background thread; the session's thread must pass them
            to `receive`.

    Attributes:
        survey: as far as it is filled, None where none is followed.
        revision: number of updates, since a survey is filled in place.
    """

    def __init__(self, surveys: Surveys, notify: Callable[[SurveyUpdate], None]) -> None:
        self._surveys = surveys
        self._notify = notify
        self._requested: tuple[Opened, Parameters, Engine] | None = None
        self.survey: Survey | None = None
        self.revision = 0

    def follows(self, opened: Opened, parameters: Parameters) -> bool:
        """Whether the survey of a recording with these parameters, by this engine, is followed."""
        return self._requested == (opened, parameters, current_engine())

    def follow(self, opened: Opened, parameters: Parameters, near: int) -> None:
        """Request the survey of a recording with these parameters, unless it is followed already.

        Args:
            opened: must stay open until the next `follow` or `stop`.
            parameters: of the estimates.
            near: the frame that is looked at.
        """
        if self.follows(opened, parameters):
            return
        requested = (opened, parameters, current_engine())
        self._requested, notify = requested, self._notify
        self.survey = self._surveys.request(
            self, opened, parameters, lambda survey: notify(SurveyUpdate(requested, survey)), near
        )
        self.revision += 1

    def receive(self, update: SurveyUpdate) -> None:
        """Apply an update, unless another survey was requested meanwhile."""
        if update.requested is self._requested:
            self.survey = update.survey
            self.revision += 1

    def stop(self) -> None:
        """Stop following."""
        self._surveys.cancel(self)
        self._requested = self.survey = None
