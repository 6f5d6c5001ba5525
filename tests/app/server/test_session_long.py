"""Sessions with long recordings, whose truth is read while the page works."""

import threading
from typing import Any

import numpy as np
import pytest

from app.analysis import true_motions
from app.analysis.estimates import Estimates
from app.analysis.library import Library
from app.server.session import Session, Shared
from app.session.reload import Reloads
from estimator import Parameters
from tests.app.drawn import shown_frame
from tests.app.fake_recordings import SPEED, fake_recording
from tests.app.page_calls import frames_of
from tests.app.waiting import until

FRAMES, STOP = 300, 200


@pytest.fixture
def truth(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Of a recording that moves in the middle and in the end; reading it waits at a frame."""
    monkeypatch.setattr("app.analysis.timeline._MOST_AT_ONCE", 100)
    monkeypatch.setattr(true_motions, "_QUIET", 0.0)
    monkeypatch.setattr(true_motions, "_PIECE", 0.0)
    monkeypatch.setattr(true_motions, "_NOTIFY_INTERVAL", 0.0)
    go_on = threading.Event()

    def velocity(k: int) -> Any:
        reading = threading.current_thread().name == "truth"
        assert not (reading and k == STOP) or go_on.wait(20)
        return SPEED if 120 <= k < 180 or 280 <= k < 290 else np.zeros(3)

    velocity.go_on = go_on  # type: ignore[attr-defined]
    return velocity


@pytest.fixture
def session(client, tmp_path, truth):
    for name in ("a", "b"):
        (tmp_path / f"{name}.mcap").touch()

    def opener(path):
        recording = fake_recording(name=path.stem, frames=FRAMES if path.stem == "a" else 40)
        recording.path = path
        if path.stem == "a":
            recording.truth = truth
        return recording

    library = Library([tmp_path], opener)
    session = Session(client, Shared(library, Estimates(), Reloads(), Parameters()))
    yield session
    truth.go_on.set()
    session.close()
    session.join(10)


def events(client) -> dict[str, Any]:
    [shown] = client.shown("timeline.events") or [{}]
    return shown


def test_the_page_works_before_the_truth_is_read_and_is_told_of_it(session, client, truth):
    until(lambda: events(client).get("unread") == FRAMES - STOP)
    assert frames_of(events(client)["moving"]) == list(range(120, 180))
    assert shown_frame(client) in range(128, 180)
    client.tell("seek", {"frame": 250})
    until(lambda: shown_frame(client) == 250)
    client.tell("motion", {"direction": 1})
    said = "Nothing begins to move after this frame as far as the truth was read."
    until(lambda: said in client.notifications)
    truth.go_on.set()
    until(lambda: events(client)["unread"] == 0)
    moving = [*range(120, 180), *range(280, 290)]
    until(lambda: frames_of(events(client)["moving"]) == moving)
    client.tell("motion", {"direction": 1})
    until(lambda: shown_frame(client) == 280)


def test_that_no_pair_counts_is_said_once_all_is_read(client, tmp_path, truth):
    (tmp_path / "a.mcap").touch()
    recording = fake_recording(name="a", frames=FRAMES)
    recording.path = tmp_path / "a.mcap"
    recording.truth = lambda k: 0 * truth(k)
    library = Library([tmp_path], lambda _: recording)
    session = Session(client, Shared(library, Estimates(), Reloads(), Parameters()))
    until(lambda: events(client).get("unread") == FRAMES - STOP)
    assert "1 note" not in client.text()
    truth.go_on.set()
    until(lambda: "1 note" in client.text())
    session.close()
    session.join(10)


def test_another_recording_ends_the_reading(session, client, truth):
    until(lambda: events(client).get("unread") == FRAMES - STOP)
    client.choose("b")
    until(lambda: client.recording() == "b" and events(client)["unread"] == 0)
    truth.go_on.set()
    until(lambda: session._shared.motions.idle)
    client.choose("a")
    until(lambda: client.recording() == "a")
    until(lambda: frames_of(events(client)["moving"])[-1] == 289)
