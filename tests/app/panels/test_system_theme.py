"""The page is dark as the system is, until a person chooses."""

from app.panels.system_theme import SystemTheme
from app.scene.settings import ViewSettings
from app.session.commands import FollowSystem
from tests.app.fake_session import context, snapshot


def test_what_the_system_becomes_is_posted_and_what_the_page_is_is_kept(client):
    posted = []
    panel = SystemTheme(context(client, posted.append))
    client.tell("system", {"dark": True})
    client.tell("system", {"dark": 1})
    assert posted == [FollowSystem(dark=True)]
    for dark, follows in ((False, True), (False, True), (True, True), (True, False)):
        panel.show(snapshot(settings=ViewSettings(dark=dark, follows_system=follows)))
    assert client.called("opening.theme") == [[False, False], [True, False], [True, True]]
