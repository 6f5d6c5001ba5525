"""Surveys of both sides of a comparison."""

from typing import Any

from app.analysis.survey import Survey
from app.session.commands import ReceiveSurveyUpdates
from app.session.followed_sides import FollowedSides
from app.session.followed_survey import SurveyUpdate
from estimator import Parameters, current_engine
from tests.app.fake_recordings import fake_opened
from tests.app.session.test_followed_survey import Background

FIRST, SECOND = Parameters(), Parameters(n=3)


def test_both_sides_are_followed_and_what_is_known_stays_when_they_are_switched():
    background: Any = Background()
    news: list[Any] = []
    sides, opened = FollowedSides(background, news.append), fake_opened()
    sides.follow(opened, FIRST, None, 20)
    sides.follow(opened, FIRST, SECOND, 20)
    assert [parameters for parameters, _ in background.asked] == [FIRST, SECOND]
    surveys = [Survey(opened.recording, parameters) for parameters in (FIRST, SECOND)]
    for (_, notify), survey in zip(background.asked, surveys, strict=True):
        notify(survey)
    for one in news:
        sides.receive(one)
    assert [sides.edited.survey, sides.other.survey] == surveys
    sides.follow(opened, SECOND, FIRST, 20)
    assert [sides.other.survey, sides.edited.survey] == surveys
    assert len(background.asked) == 2
    sides.follow(opened, FIRST, None, 20)  # B is removed
    assert sides.edited.survey is surveys[0]
    assert sides.other.survey is None
    assert len(background.asked) == 2
    sides.stop()
    assert sides.edited.survey is None


def test_the_last_update_of_each_survey_is_kept():
    opened = fake_opened()
    engine = current_engine()
    first, second = (opened, FIRST, engine), (opened, SECOND, engine)
    survey = Survey(opened.recording, FIRST)
    updates = [SurveyUpdate(requested, survey) for requested in (first, second, first)]
    merged = ReceiveSurveyUpdates((updates[0],))
    for update in updates[1:]:
        merged = ReceiveSurveyUpdates((update,)).merged_with(merged)
    assert len(merged.updates) == 2
    assert merged.updates[0] is updates[1]
    assert merged.updates[1] is updates[2]
