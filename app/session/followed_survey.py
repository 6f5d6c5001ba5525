"""The survey of what a session shows, which the background fills."""

from collections.abc import Callable
from dataclasses import dataclass

from app.analysis.library import Opened
from app.analysis.survey import Survey
from app.analysis.surveys import Surveys
from estimator import Parameters


@dataclass(frozen=True)
class SurveyUpdate:
    """Survey that has come further.

    Attributes:
        asked: recording and parameters that it was asked for with.
        survey: as far as it is filled.
    """

    asked: tuple[Opened, Parameters]
    survey: Survey


class FollowedSurvey:
    """Asks the background for one survey at a time; used by the session's thread alone.

    Args:
        surveys: computes whole recordings in the background.
        tell: takes the news, from the background's thread; `receive` is to be called with them by
            the session's thread.

    Attributes:
        survey: as far as it is filled, None before the first numbers are there.
        revision: grows with all news, since a survey is filled in place.
    """

    def __init__(self, surveys: Surveys, tell: Callable[[SurveyUpdate], None]) -> None:
        self._surveys = surveys
        self._tell = tell
        self._asked: tuple[Opened, Parameters] | None = None
        self.survey: Survey | None = None
        self.revision = 0

    def follow(self, opened: Opened, parameters: Parameters) -> None:
        """Ask for the survey of a recording with these parameters, unless it is followed already.

        Args:
            opened: stays open until another survey is followed, or none.
            parameters: of the estimates.
        """
        asked = (opened, parameters)
        if asked == self._asked:
            return
        self._asked, self.survey, tell = asked, None, self._tell
        self._surveys.request(self, *asked, lambda survey: tell(SurveyUpdate(asked, survey)))

    def receive(self, news: SurveyUpdate) -> None:
        """Take note of news, unless something else was asked for meanwhile."""
        if news.asked is self._asked:
            self.survey = news.survey
            self.revision += 1

    def stop(self) -> None:
        """Follow none."""
        self._surveys.cancel(self)
        self._asked = self.survey = None
