from collections import Counter

from viser._messages import GuiPanelMessage

from app.browser.internals import hints_of
from app.panels.page import Page
from tests.app.fake_session import context


def test_no_two_commands_share_a_key_or_a_name(client):
    Page(context(client))
    commands = list(client.gui._command_handle_from_uuid.values())
    keys = Counter((c.modifier, c.hotkey) for c in commands if c.hotkey)
    assert len(keys) > 15
    assert [key for key, number in keys.items() if number > 1] == []
    assert [n for n, count in Counter(c.label for c in commands).items() if count > 1] == []


def test_the_parameters_are_in_sight_and_the_rest_is_in_tabs(client):
    Page(context(client))
    panels = [m.props._tab_labels for m in client.sent if isinstance(m, GuiPanelMessage)]
    assert ("Explain", "Compare", "View", "Export", "More") in panels
    assert client.shown("showHints") == [hints_of(client)]
    assert len(hints_of(client)) > 20
