from dataclasses import replace

import pytest

from app.analysis.comparison import B, Comparison
from app.panels.corner_line import CornerLinePanel
from app.scene.scale_bar import ScaleBar
from app.scene.settings import ViewSettings
from estimator import Parameters
from tests.app.fake_session import context, snapshot


class Corner:
    """The panel, and what it has the page show."""

    def __init__(self, client):
        self._client = client
        self._panel = CornerLinePanel(context(client))

    def shows(self, **changes):
        self._client.take_sent()
        self._panel.show(snapshot(**changes))
        return [content for (content,) in self._client.called("corner.show")]


@pytest.fixture
def corner(client):
    return Corner(client)


def test_it_says_what_is_drawn_and_how_large(corner):
    (shown,) = corner.shows(frame=20, scale_bar=ScaleBar(0.5, 0.25))
    assert shown["parts"][:2] == ["fake", "frame 20 of 39"]
    assert (shown["text"], shown["share"], shown["dark"]) == ("50 cm", 0.25, False)


def test_it_is_sent_only_when_it_changes(corner):
    assert len(corner.shows(frame=20)) == 1
    assert corner.shows(frame=20) == []
    assert len(corner.shows(frame=21)) == 1


def test_it_goes_with_the_legend(corner):
    (shown,) = corner.shows(settings=replace(ViewSettings(), legend=False))
    assert shown["parts"] == []


def test_both_sides_are_named_where_both_are_drawn(corner):
    other = Comparison(Parameters(delta=0.1), edited=B, both=True)
    (shown,) = corner.shows(comparison=other)
    assert [part[:2] for part in shown["parts"][-2:]] == ["A:", "B:"]
