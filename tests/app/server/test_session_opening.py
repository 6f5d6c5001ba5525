"""Sessions that open recordings, good and bad."""

import threading
from dataclasses import replace

import numpy as np

from app.analysis.estimates import Estimates
from app.analysis.library import Library
from app.server.session import Session, Shared
from app.session.commands import OpenRecording
from app.session.reload import Reloads
from estimator import Parameters
from recordings import RecordingError
from tests.app.drawn import points, shown_frame
from tests.app.fake_recordings import fake_recording
from tests.app.waiting import until


def test_a_bad_file_is_told_in_a_card_and_what_was_shown_stays(session, client):
    before = points(client, "target")
    client.choose("bad")
    until(lambda: client.shown("failure.show"))
    title, reason, advice = client.shown("failure.show")
    assert title == "bad cannot be opened"
    assert reason == "It is no recording."
    assert advice.startswith("a stays open.\nWhat the file holds: tofscope info /")
    until(lambda: client.recording() == "a")
    assert np.array_equal(points(client, "target"), before)
    client.choose("b")
    until(lambda: session._shared.library._shared.keys() >= {session._shared.library.listing()[1]})
    client.tell("seek", {"frame": 12})
    until(lambda: shown_frame(client) == 12)


def test_only_what_is_listed_is_opened(session, client, folder):
    (folder / "later.mcap").touch()
    for label in ("/etc/passwd", "../a", "later"):
        session._queue.post(OpenRecording(label))
        client.tell("seek", {"frame": 20 + len(label)})
        until(lambda label=label: shown_frame(client) == 20 + len(label))
    assert [e.label for e in session._shared.library._shared] == ["a"]


def test_what_is_being_opened_is_said_meanwhile(client, shared, folder, runs):
    opening, go_on = threading.Event(), threading.Event()

    def opener(path):
        if path.stem == "b":
            opening.set()
            assert go_on.wait(10)
        return fake_recording(name=path.stem)

    session = Session(client, replace(shared, library=Library([folder], opener)))
    until(lambda: "Moving" in client.text())
    client.choose("b")
    assert opening.wait(10)
    until(lambda: "Opening b …" in client.text())
    assert client.recording() == "b"
    go_on.set()
    until(lambda: "Opening" not in client.text())
    assert "1 sensor, 40 frames" in client.text()
    session.close()
    session.join(10)


def test_an_empty_folder_says_what_to_do(client, tmp_path):
    (tmp_path / "empty").mkdir()
    library = Library([tmp_path / "empty"], lambda path: fake_recording(name=path.stem))
    session = Session(client, Shared(library, Estimates(), Reloads(), Parameters()))
    until(lambda: "There is no recording here." in client.markdown())
    assert str(tmp_path / "empty") in client.markdown()
    session.close()
    session.join(10)


def test_a_bad_recording_at_the_front_does_not_keep_the_others_from_opening(client, shared, folder):
    (folder / "0_bad.mcap").touch()

    def opener(path):
        if "bad" in path.stem:
            raise RecordingError(f"{path.name} is no recording.")
        return fake_recording(name=path.stem)

    shared = replace(shared, library=Library([folder], opener))
    session = Session(client, shared)
    until(lambda: "Moving" in client.text())
    assert client.notifications == ["0_bad.mcap is no recording."]
    session.close()
    session.join(10)


def test_of_several_bad_recordings_the_first_is_told_and_the_others_are_counted(client, shared):
    def opener(path):
        raise RecordingError(f"{path.name} is no recording.")

    library = Library([shared.library.paths[0]], opener)
    session = Session(client, replace(shared, library=library))
    until(lambda: client.shown("failure.show"))
    title, reason, advice = client.shown("failure.show")
    assert title == "a cannot be opened"
    assert reason == "a.mcap is no recording. 2 more could not be opened."
    assert advice.startswith("No recording is open.\n")
    until(lambda: "No recording is open." in client.text())
    session.close()
    session.join(10)


def test_another_recording_is_framed_anew_wherever_the_camera_was(session, client):
    begun = np.array(client.camera.position)
    client.camera.position, client.camera.look_at = np.array([9.0, 8.0, 7.0]), np.ones(3)
    client.choose("b")
    until(lambda: np.allclose(client.camera.position, begun, atol=1e-6))
