"""Surveys of the edited parameters and of those that they are compared with."""

from collections.abc import Callable

from app.analysis.library import Opened
from app.analysis.surveys import Surveys
from app.session.followed_survey import FollowedSurvey, SurveyUpdate
from estimator import Parameters


class FollowedSides:
    """Follows one survey, or two in a comparison; used by the session's thread alone.

    Args:
        surveys: computes whole recordings in the background.
        notify: called with updates by the background thread; the session's thread must pass them
            to `receive`.

    Attributes:
        edited: survey of the edited parameters.
        other: survey of the other parameters, where there is a comparison.
    """

    def __init__(self, surveys: Surveys, notify: Callable[[SurveyUpdate], None]) -> None:
        self.edited = FollowedSurvey(surveys, notify)
        self.other = FollowedSurvey(surveys, notify)

    def follow(
        self, opened: Opened, edited: Parameters, other: Parameters | None, near: int
    ) -> None:
        """Request the surveys of a recording, unless they are followed already.

        Args:
            opened: must stay open until the next `follow` or `stop`.
            edited: parameters.
            other: those that they are compared with, None without a comparison.
            near: the frame that is looked at.
        """
        if self.other.follows(opened, edited) and not self.edited.follows(opened, edited):
            self.edited, self.other = self.other, self.edited
        self.edited.follow(opened, edited, near)
        if other is None:
            self.other.stop()
        else:
            self.other.follow(opened, other, near)

    def receive(self, update: SurveyUpdate) -> None:
        """Apply an update to the survey that it is of, unless it is followed no more."""
        self.edited.receive(update)
        self.other.receive(update)

    def stop(self) -> None:
        """Stop following."""
        self.edited.stop()
        self.other.stop()
