"""Events of our own elements reach the session, whatever else a browser sends."""

import pytest

from app.browser.page_events import EventContent, PageEvents


class Dragged(EventContent):
    frame: int


@pytest.fixture
def received(client):
    frames: list[int] = []
    PageEvents(client).on("dragged", Dragged, lambda content: frames.append(content.frame))
    return frames


def test_an_event_arrives_as_often_as_it_was_sent(client, received):
    client.tell("dragged", {"frame": 3})
    client.tell("dragged", {"frame": 3})
    assert received == [3, 3]


@pytest.mark.parametrize(
    "data", [None, {}, {"frame": "3"}, {"frame": 1.5}, {"frame": 3, "more": 1}, [3], "x" * 30_000]
)
def test_what_is_not_understood_is_dropped(client, received, data):
    client.tell("dragged", data)
    client.tell("unknown", {"frame": 1})
    client.change("Events of the page", "{")
    client.tell("dragged", {"frame": 4})
    assert received == [4]
