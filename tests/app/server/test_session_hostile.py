"""A session whose client sends whatever it likes for its controls."""

import logging
import traceback
from pathlib import Path

import pytest

import app
from app.browser.visitor import Visitor
from tests.app.drawn import shown_frame
from tests.app.waiting import until

NUMBERS = [-1, 0, 1e9, -1e300, 1e300, 0.0, 2**63, -(2**63), 3.5, True]
TEXTS = ["", " ", "0x", "abc", "NaN", "inf", "1e999", "-1", "none", "7 moving", "x" * 10_000, "\0"]
LISTS = [[], [1], [5, 3], [1, 2, 3], [-1e300, 1e300], ["a", "b"], [1e9, 2e9]]
OURS = str(Path(app.__file__).parent)


def answered(client, session) -> None:
    """Wait until the session has applied all that was posted, and drawn it."""
    frame = 20 if shown_frame(client) != 20 else 21
    client.tell("seek", {"frame": frame})
    until(lambda: shown_frame(client) == frame)


def send(client, control, value) -> None:
    """Send a value; viser may refuse to convert it, but no callback of ours may fail."""
    try:
        client._send(control, value)
    except Exception as error:
        places = [frame.filename for frame in traceback.extract_tb(error.__traceback__)]
        at = "".join(traceback.format_exception(error))
        assert not any(place.startswith(OURS) for place in places), f"{control.label}: {at}"


def controls(client):
    return [*client.gui._gui_input_handle_from_uuid.values()]


@pytest.mark.parametrize("values", [NUMBERS, TEXTS, LISTS], ids=["numbers", "texts", "lists"])
def test_no_value_of_any_control_ends_the_session_or_is_unexpected(session, client, caplog, values):
    assert len(controls(client)) > 40
    for control in controls(client):
        for value in values:
            send(client, control, value)
        answered(client, session)
    errors = [r.getMessage() for r in caplog.records if r.levelno >= logging.ERROR]
    assert not errors
    assert not [said for said in client.notifications if "unexpected" in said]
    assert session._thread.is_alive()


KINDS = ("seek", "step", "play", "motion", "playback", "strip", "mark", "unmark")
FIELDS = ("frame", "frames", "direction", "speed", "loop", "first", "last", "name", "text")


def test_no_event_of_the_page_ends_the_session_or_is_unexpected(session, client, caplog):
    for kind in KINDS:
        for value in (None, *NUMBERS, *TEXTS[:4], TEXTS[-2], TEXTS[-1], *LISTS):
            client.tell(kind, value)
            client.tell(kind, dict.fromkeys(FIELDS, value))
            for field in FIELDS:
                client.tell(kind, {field: value})
    if client.shown("timeline.playback")[0]["playing"]:
        client.tell("play", {})
    answered(client, session)
    assert not [r.getMessage() for r in caplog.records if r.levelno >= logging.ERROR]
    assert not [said for said in client.notifications if "unexpected" in said]
    assert session._thread.is_alive()


def test_what_is_not_among_the_options_is_told_or_left_out(session, client):
    client.change("Cluster", "x of nine")
    until(lambda: any("no cluster 'x of nine'" in said for said in client.notifications))
    answered(client, session)


def test_the_visitor_lets_pass_what_the_session_is_tried_with(client):
    from viser._messages import GuiUpdateMessage

    visitor = Visitor(lambda: client, lambda: None, None)  # type: ignore[arg-type]
    for value in (*NUMBERS, *TEXTS, *LISTS):
        assert visitor.admits(GuiUpdateMessage("u", {"value": value})), value
