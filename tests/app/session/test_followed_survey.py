from typing import Any

from app.analysis.survey import Survey
from app.session.followed_survey import FollowedSurvey
from estimator import Parameters
from tests.app.fake_recordings import fake_opened


class Background:
    """Surveys that are told when the test says so."""

    def __init__(self):
        self.asked, self.left = [], 0

    def request(self, owner, opened, parameters, notify, near):
        assert near == 20
        self.asked.append((parameters, notify))
        return Survey(opened.recording, parameters)

    def cancel(self, owner):
        self.left += 1


def test_what_is_shown_is_asked_for_once_and_its_news_are_counted():
    background: Any = Background()
    news: list[Any] = []
    followed, opened = FollowedSurvey(background, news.append), fake_opened()
    followed.follow(opened, Parameters(), 20)
    followed.follow(opened, Parameters(), 20)
    ((parameters, notify),) = background.asked
    assert parameters == Parameters()
    survey = Survey(opened.recording, Parameters())
    notify(survey)
    notify(survey)
    assert followed.survey is not survey  # until the session takes the news
    before = followed.revision
    for one in news:
        followed.receive(one)
    assert followed.survey is survey
    assert followed.revision == before + 2


def test_news_of_what_was_left_are_not_taken():
    background: Any = Background()
    news: list[Any] = []
    followed, opened = FollowedSurvey(background, news.append), fake_opened()
    followed.follow(opened, Parameters(), 20)
    background.asked[0][1](Survey(opened.recording, Parameters()))
    followed.follow(opened, Parameters(n=3), 20)
    followed.receive(news[0])
    assert followed.survey is not None
    assert followed.survey.parameters.n == 3
    background.asked[1][1](Survey(opened.recording, Parameters(n=3)))
    before = followed.survey
    followed.receive(news[1])
    assert followed.survey is not before
    followed.stop()
    assert followed.survey is None
    assert background.left == 1
    followed.receive(news[1])
    assert followed.survey is None
