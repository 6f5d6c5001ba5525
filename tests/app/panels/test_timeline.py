"""The timeline: what it is sent, what its events do in a session, and the commands of playback."""

import itertools
import time

import numpy as np
import pytest

from app.analysis.estimates import Estimates
from app.analysis.library import Library
from app.panels.timeline import EditMark, PutMark, TimelinePanel
from app.server.session import Session, Shared
from app.session.clock import SPEEDS
from app.session.reload import Reloads
from estimator import Parameters
from tests.app.drawn import shown_frame
from tests.app.fake_recordings import FRAMES, PERIOD, SPEED, fake_recording
from tests.app.fake_session import context
from tests.app.page_calls import frames_of, unpacked
from tests.app.waiting import until


@pytest.fixture
def session(client, tmp_path):
    (tmp_path / "a.mcap").touch()

    def opener(path):
        recording = fake_recording(name=path.stem)
        recording.path = path
        recording.truth = lambda k: SPEED if 12 <= k < 20 or 30 <= k < 34 else np.zeros(3)
        return recording

    library = Library([tmp_path], opener)
    session = Session(client, Shared(library, Estimates(), Reloads(), Parameters()))
    until(lambda: client.shown("timeline.quantity"))
    yield session
    session.close()
    session.join(10)


def at(client, frame):
    return lambda: shown_frame(client) == frame


def playback(client):
    shown = client.shown("timeline.playback")
    return shown[0] if shown else {}


def go(client, frame):
    client.tell("seek", {"frame": frame})
    until(at(client, frame))


def test_it_knows_the_recording_once_a_session_begins(session, client):
    times, speeds = client.shown("timeline.open")
    np.testing.assert_allclose(unpacked(times), PERIOD * np.arange(FRAMES), rtol=1e-6)
    assert tuple(speeds) == SPEEDS
    moving = [*range(12, 20), *range(30, 34)]
    until(lambda: frames_of(client.shown("timeline.events")[0]["moving"]) == moving)
    assert client.shown("timeline.quantity")[0]["chosen"] == "moving"
    assert client.shown("timeline.marks") == [[]]
    assert playback(client) == {
        **{"playing": False, "first": 0, "last": FRAMES - 1, "speed": 1.0, "loop": True}
    }


def test_jumps_to_where_something_begins_to_move(session, client):
    go(client, 14)
    client.tell("motion", {"direction": 1})
    until(at(client, 30))
    client.tell("motion", {"direction": -1})
    until(at(client, 12))
    client.tell("motion", {"direction": -1})
    until(lambda: "Nothing begins to move before this frame." in client.notifications)
    assert shown_frame(client) == 12
    client.tell("motion", {"direction": -1})
    until(lambda: client.notifications.count("Nothing begins to move before this frame.") == 2)
    assert client.removed == ["Nothing begins to move before this frame."]


def test_two_jumps_in_a_row_are_two(session, client):
    go(client, 0)
    client.trigger("Next motion")
    client.trigger("Next motion")
    until(at(client, 30))


def test_commands_go_to_the_ends_and_step(session, client):
    client.trigger("First frame")
    until(at(client, 0))
    client.trigger("Ten frames on")
    until(at(client, 10))
    client.trigger("Previous frame")
    until(at(client, 9))
    client.trigger("Last frame")
    until(at(client, FRAMES - 1))


def test_commands_change_the_speed_and_stay_within_what_is_offered(session, client):
    client.trigger("Faster")
    until(lambda: playback(client)["speed"] == 2.0)
    for _ in range(9):
        client.trigger("Slower")
    until(lambda: playback(client)["speed"] == 0.1)


def test_the_chosen_speed_is_played_and_without_a_loop_it_ends(session, client):
    client.tell("playback", {"speed": 5.0, "loop": False})
    go(client, FRAMES - 31)
    start = time.monotonic()
    client.tell("play", {})
    until(at(client, FRAMES - 1))
    assert 0.3 < time.monotonic() - start < 1.8  # 2 s at the recording's own speed
    until(lambda: not playback(client)["playing"])


def test_a_loop_stays_within_its_range(session, client):
    client.tell("playback", {"first": 20, "last": 22})
    until(lambda: playback(client)["loop"])
    go(client, 20)
    client.tell("play", {})
    seen = []

    def round_twice():
        seen.append(shown_frame(client))
        begun = sum(a > b for a, b in itertools.pairwise(seen))
        return begun >= 2 and len(set(seen)) >= 3

    until(round_twice)
    assert set(seen) == {20, 21, 22}
    assert playback(client)["playing"]
    client.trigger("Loop on or off")
    until(lambda: not playback(client)["loop"])


def test_steps_of_the_page_add_up_and_end_at_the_ends(session, client):
    go(client, 20)
    client.tell("step", {"frames": -1})
    client.tell("step", {"frames": -10})
    until(at(client, 9))
    client.tell("step", {"frames": -10})
    until(at(client, 0))


def test_a_mark_is_kept_beside_the_recording_edited_and_removed(session, client, tmp_path):
    file = tmp_path / "a.mcap.marks.json"
    client.tell("mark", {"frame": 30, "text": "it stops"})
    client.tell("mark", {"frame": 12, "text": ""})
    until(lambda: len(client.shown("timeline.marks")[0]) == 2)
    assert client.shown("timeline.marks")[0] == [
        {"frame": 12, "text": ""},
        {"frame": 30, "text": "it stops"},
    ]
    assert "it stops" in file.read_text("utf-8")
    client.tell("mark", {"frame": 12, "text": "it begins"})
    client.tell("unmark", {"frame": 30})
    until(lambda: client.shown("timeline.marks") == [[{"frame": 12, "text": "it begins"}]])
    assert "it stops" not in file.read_text("utf-8")


def test_a_file_of_marks_that_is_none_is_told_and_left_alone(client, shared, folder):
    file = folder / "a.mcap.marks.json"
    file.write_text("my notes")
    session = Session(client, shared)
    until(lambda: client.shown("timeline.marks"))
    told = f"{file} holds no marks of Tofscope; move it away to put marks here."
    assert client.notifications == [told]
    client.tell("mark", {"frame": 3, "text": "here"})
    until(lambda: client.notifications == [told, told])
    assert file.read_text() == "my notes"
    assert client.shown("timeline.marks") == [[]]
    session.close()
    session.join(10)


def test_the_key_of_marks_opens_the_card_of_this_frame(session, client):
    go(client, 17)
    assert client.shown("timeline.edit") is None
    client.trigger("Mark this frame")
    until(lambda: client.shown("timeline.edit") == [17])


@pytest.mark.parametrize(
    ("kind", "data"),
    [
        ("seek", {"frame": -1}),
        ("seek", {"frame": 10**9}),
        ("step", {"frames": 10**6}),
        ("motion", {"direction": 2}),
        ("playback", {"speed": 3.0}),
        ("playback", {"first": -1}),
        ("strip", {"name": "__class__"}),
        ("strip", {"name": "done"}),
        ("mark", {"frame": 1, "text": "x" * 501}),
        ("mark", {"frame": 1}),
    ],
)
def test_events_that_no_page_sends_are_dropped(client, kind, data):
    posted = []
    TimelinePanel(context(client, posted.append))
    client.tell(kind, data)
    assert posted == []
    client.tell("unmark", {"frame": 3})
    assert posted == [PutMark({3: None})]


def test_notes_of_several_frames_are_all_kept_the_later_one_of_each():
    first = PutMark({3: "a", 4: "b"})
    assert PutMark({4: None, 5: "c"}).merged_with(first) == PutMark({3: "a", 4: None, 5: "c"})
    assert EditMark().merged_with(EditMark()) == EditMark()
