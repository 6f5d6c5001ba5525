"""Controls and commands of playback in a session."""

import itertools
import time

import numpy as np
import pytest

from app.analysis.estimates import Estimates
from app.analysis.library import Library
from app.panels.playback import PlaybackPanel
from app.server.session import Session, Shared
from app.session.reload import Reloads
from estimator import Parameters
from tests.app.fake_recordings import FRAMES, SPEED, fake_opened, fake_recording
from tests.app.fake_session import context
from tests.app.waiting import until


@pytest.fixture
def session(client, tmp_path):
    (tmp_path / "a.mcap").touch()

    def opener(path):
        recording = fake_recording(name=path.stem)
        recording.truth = lambda k: SPEED if 12 <= k < 20 or 30 <= k < 34 else np.zeros(3)
        return recording

    library = Library([tmp_path], opener)
    session = Session(client, Shared(library, Estimates(), Reloads(), Parameters()))
    until(lambda: "Moving" in client.text())
    yield session
    session.close()
    session.join(10)


def at(client, frame):
    return lambda: f"Frame {frame} of" in client.text()


def test_jumps_to_where_something_begins_to_move(session, client):
    client.change("Frame", 14)
    until(at(client, 14))
    client.change("Motion", "Next")
    until(at(client, 30))
    client.change("Motion", "Previous")
    until(at(client, 12))
    client.change("Motion", "Previous")
    until(lambda: "Nothing begins to move before this frame." in client.notifications)
    assert client.control("Frame").value == 12
    client.change("Motion", "Previous")
    until(lambda: client.notifications.count("Nothing begins to move before this frame.") == 2)
    assert client.removed == ["Nothing begins to move before this frame."]


def test_two_jumps_in_a_row_are_two(session, client):
    client.change("Frame", 0)
    until(at(client, 0))
    client.trigger("Next motion")
    client.trigger("Next motion")
    until(at(client, 30))


def test_commands_go_to_the_ends_and_step(session, client):
    client.trigger("First frame")
    until(at(client, 0))
    client.trigger("Ten frames on (Shift →)")
    until(at(client, 10))
    client.trigger("Previous frame")
    until(at(client, 9))
    client.trigger("Last frame")
    until(at(client, FRAMES - 1))


def test_commands_change_the_speed_and_stay_within_what_is_offered(session, client):
    client.trigger("Faster")
    until(lambda: client.control("Speed").value == "2x")
    for _ in range(9):
        client.trigger("Slower")
    until(lambda: client.control("Speed").value == "0.1x")


def test_the_chosen_speed_is_played(session, client):
    client.change("Speed", "5x")
    client.change("Frame", FRAMES - 31)
    until(at(client, FRAMES - 31))
    start = time.monotonic()
    client.press("Play")
    until(at(client, FRAMES - 1))
    assert 0.3 < time.monotonic() - start < 1.8  # 2 s at the recording's own speed


def test_a_loop_stays_within_its_range(session, client):
    client.change("Range", (20, 22))
    client.change("Speed", "5x")
    client.trigger("Loop on or off")
    until(lambda: client.control("Loop").value)
    client.change("Frame", 20)
    until(at(client, 20))
    client.press("Play")
    seen, end = [], time.monotonic() + 0.6
    while time.monotonic() < end:
        seen.append(client.control("Frame").value)
        time.sleep(0.002)
    assert set(seen) == {20, 21, 22}
    assert sum(a > b for a, b in itertools.pairwise(seen)) >= 2
    assert any(button.label == "Pause" for button in client.buttons())


def test_of_one_frame_there_is_no_range(client):
    single = fake_recording()
    single.stamps = single.stamps[:1]
    panel = PlaybackPanel(context(client))
    panel.open(fake_opened())
    assert client.control("Range").visible
    panel.open(fake_opened(single))
    assert not client.control("Range").visible
