import logging
import threading
import time

import numpy as np
import pytest

from app.scene.scene_root import FIXED
from app.server.session import Session
from estimator import Parameters
from tests.app.drawn import arrow_count, points, shown_frame
from tests.app.fake_client import FakeClient
from tests.app.fake_recordings import FRAMES
from tests.app.waiting import until


def sent_nodes(client):
    return [getattr(message, "name", None) for message in client.take_sent()]


def test_it_begins_with_the_first_recording_in_the_middle_of_its_motion(session, client):
    assert client.recording() == "a"
    assert shown_frame(client) == 24
    assert arrow_count(client) == 100
    assert client.shown("timeline.playback")[0]["last"] == FRAMES - 1
    assert len(points(client, "truth")) == 1


def test_n_changes_the_source_alone(session, client):
    source, target = points(client, "source"), points(client, "target")
    client.take_sent()
    client.change("n", 5)
    until(lambda: not np.array_equal(points(client, "source"), source))
    until(lambda: "0.333 s" in client.text())
    assert np.array_equal(points(client, "target"), target)
    names = sent_nodes(client)
    assert f"{FIXED}/source" in names
    assert f"{FIXED}/target" not in names
    assert f"{FIXED}/frustums/front" not in names


def test_scrubbing_changes_both_clouds(session, client):
    source, target = points(client, "source"), points(client, "target")
    client.tell("seek", {"frame": 30})
    until(lambda: shown_frame(client) == 30)
    assert not np.array_equal(points(client, "source"), source)
    assert not np.array_equal(points(client, "target"), target)


def test_delta_at_its_largest_leaves_no_arrow_and_back_brings_them_again(session, client):
    before = points(client, "flow")
    client.change("δ", client.control("δ").max)
    until(lambda: arrow_count(client) == 0)
    client.change("δ", 0.04)
    until(lambda: arrow_count(client) == 100)
    assert np.array_equal(points(client, "flow"), before)


def test_before_the_first_pair_it_says_so(session, client):
    client.tell("seek", {"frame": 3})
    until(lambda: "No pair: frame k-n = -5 is before the start." in client.text())
    assert len(points(client, "source")) == 0
    assert arrow_count(client) == 0
    assert len(points(client, "target")) == 500


def test_the_view_does_not_run_the_estimator(session, client, runs):
    count, before = len(runs), points(client, "flow")
    client.take_sent()
    client.change("Arrow scale", 2.0)
    until(lambda: not np.array_equal(points(client, "flow"), before))
    tips, sources = points(client, "flow")[:, 1], points(client, "source")
    np.testing.assert_allclose(tips - sources, 2 * (before[:, 1] - sources), atol=1e-5)
    radius = client.node(f"{FIXED}/source").point_size
    client.change("Point size", 14.0)
    until(lambda: client.node(f"{FIXED}/source").point_size == pytest.approx(2 * radius))
    client.change("Robot", False)
    until(lambda: not client.node(f"{FIXED}/robot").visible)
    assert len(runs) == count
    changed = {n for n in sent_nodes(client) if n}
    assert f"{FIXED}/frustums/front" not in changed


def test_two_hundred_changes_in_a_second_end_on_the_last_one(session, client, runs):
    runs.delay = 0.05
    count = len(runs)
    values = np.linspace(0.0, 0.5, 200)
    for value in values:
        client.change("δ", float(value))
        time.sleep(0.004)
    last = time.monotonic()
    until(lambda: runs.parameters[-1].delta == 0.5)
    until(lambda: arrow_count(client) == 0)
    assert time.monotonic() - last < 1.0
    assert len(runs) - count < 60


def test_a_number_beyond_its_range_becomes_the_nearest_in_it_and_is_said(session, client, runs):
    client.change("γ", 9.0)
    until(lambda: client.shown("fields.say"))
    assert client.shown("fields.say")[1] == "γ goes from 0 to 1: 9 became 1."
    until(lambda: runs.parameters[-1] == Parameters(gamma=1.0))
    client.change("γ", 1.0)  # a browser's, once the field is left
    client.change("δ", 0.05)
    until(lambda: runs.parameters[-1] == Parameters(gamma=1.0, delta=0.05))
    assert client.control("γ").value == 1.0
    client.change("γ", 0.6)
    until(lambda: runs.parameters[-1] == Parameters(gamma=0.6, delta=0.05))
    until(lambda: client.shown("fields.say")[1] == "")


def test_reset_brings_the_defaults_back(session, client, runs):
    client.change("δ", 0.3)
    client.change("n", 4)
    until(lambda: runs.parameters[-1] == Parameters(n=4, delta=0.3))
    client.change("Reset", "all")
    until(lambda: client.control("δ").value == 0.04)
    assert client.control("n").value == 8


def test_parameters_without_a_slider_have_fields(session, client, runs):
    client.change("method", "baseline")
    client.change("min samples (0 = unset)", 5)
    client.change("allow single cluster", True)
    until(
        lambda: (
            runs.parameters[-1]
            == Parameters(method="baseline", min_samples=5, allow_single_cluster=True)
        )
    )
    client.change("min samples (0 = unset)", 0)
    until(lambda: runs.parameters[-1].min_samples is None)


def test_an_error_of_the_estimator_is_told_and_the_clouds_are_shown(session, client, runs):
    runs.error = RuntimeError("ICP has had enough")
    client.tell("seek", {"frame": 30})
    until(lambda: any("ICP has had enough" in n for n in client.notifications))
    until(lambda: shown_frame(client) == 30 and "No estimate." in client.text())
    assert arrow_count(client) == 0
    runs.error = None
    client.tell("seek", {"frame": 31})
    until(lambda: arrow_count(client) == 100)


def test_an_unexpected_error_is_logged_once_with_its_traceback(session, client, runs, caplog):
    runs.error = RuntimeError("ICP has had enough")
    with caplog.at_level(logging.ERROR, logger="app.server.session"):
        for frame in (30, 31):
            client.tell("seek", {"frame": frame})
            until(lambda frame=frame: shown_frame(client) == frame)
    assert len(caplog.records) == 1
    assert "RuntimeError: ICP has had enough" in caplog.text
    assert "Traceback" in caplog.text


def test_playback_goes_at_the_recordings_pace_and_stops_at_the_end(session, client):
    client.tell("playback", {"loop": False})
    client.tell("seek", {"frame": FRAMES - 16})
    until(lambda: shown_frame(client) == FRAMES - 16)
    start = time.monotonic()
    client.tell("play", {})
    until(lambda: shown_frame(client) == FRAMES - 1)
    assert time.monotonic() - start == pytest.approx(1.0, abs=0.4)
    until(lambda: not client.shown("timeline.playback")[0]["playing"])


def test_playback_drops_frames_rather_than_lag(session, client, runs):
    runs.delay = 0.3
    client.tell("playback", {"loop": False})
    client.tell("seek", {"frame": FRAMES - 16})
    until(lambda: shown_frame(client) == FRAMES - 16)
    count, start = len(runs), time.monotonic()
    client.tell("play", {})
    until(lambda: shown_frame(client) == FRAMES - 1)
    assert time.monotonic() - start < 2.5
    assert len(runs) - count < 12


def test_steps_add_up(session, client):
    client.tell("step", {"frames": 1})
    client.tell("step", {"frames": 10})
    until(lambda: shown_frame(client) == 35)
    client.tell("step", {"frames": 10})
    until(lambda: shown_frame(client) == FRAMES - 1)


def test_the_end_of_a_session_gives_everything_back(client, shared, runs):
    session = Session(client, shared)
    until(lambda: "Moving" in client.text())
    (held,) = shared.library._shared.values()
    recording = held.opened.recording
    session.close()
    session.join(10)
    assert recording.closed
    assert shared.library._shared == {}
    assert "session" not in [t.name for t in threading.enumerate()]


def test_two_clients_keep_their_own_parameters_and_share_the_recording(session, client, shared):
    with FakeClient.on_a_server() as other_client:
        other = Session(other_client, shared)
        until(lambda: "Moving" in other_client.text())
        other_client.change("δ", 0.5)
        until(lambda: arrow_count(other_client) == 0)
        assert client.control("δ").value == 0.04
        assert arrow_count(client) == 100
        assert [held.users for held in shared.library._shared.values()] == [2]
        other.close()
        other.join(10)


def test_a_picked_cluster_stays_picked_until_the_recording_changes(session, client, runs):
    origin, moving = np.array([0.3, -3.0, 1.0]), points(client, "flow")[50, 0]
    client.click(tuple(origin), tuple(moving - origin))
    until(lambda: client.control("Cluster").value.endswith("moving"))
    assert len(points(client, "picked/points")) == 100
    until(lambda: "Moving: fitness 1.00 above γ 0.7" in client.text())
    client.change("δ", 0.3)
    until(lambda: client.control("Cluster").value.endswith("stationary"))
    until(lambda: "below δ 0.3 m" in client.text())
    client.change("n", 5)
    client.tell("seek", {"frame": 30})
    until(lambda: runs.parameters[-1].n == 5 and shown_frame(client) == 30)
    assert client.control("Cluster").value.endswith("stationary")
    assert client.node(f"{FIXED}/picked").visible
    client.click(tuple(origin), (0.0, 0.0, 1.0))
    until(lambda: client.control("Cluster").value == "none")
    assert not client.node(f"{FIXED}/picked").visible
    client.change("Cluster", client.control("Cluster").options[1])
    until(lambda: client.node(f"{FIXED}/picked").visible)
    client.choose("b")
    until(lambda: client.control("Cluster").value == "none")
    assert not client.node(f"{FIXED}/picked").visible


def test_surveys_are_everybodys_alike(shared):
    seen, start = [], threading.Barrier(8)

    def look():
        start.wait()
        seen.append(shared.surveys)

    threads = [threading.Thread(target=look) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(surveys is shared.surveys for surveys in seen)
    assert "surveys" in vars(shared)


def test_the_command_palette_does_what_buttons_do(session, client):
    client.trigger("Save screenshot")
    until(lambda: client.downloads)
    assert client.downloads.pop()[0] == "a_frame_0024.png"
    client.trigger("Save parameters as a file")
    until(lambda: client.downloads)
    assert client.downloads.pop()[0] == "parameters.json"
    until(lambda: "Computing the whole recording: <" not in client.text())
    client.trigger("Save plots as CSV")
    until(lambda: client.downloads)
    assert client.downloads.pop()[0] == "a_plots.csv"
    client.trigger("Save offline page")
    until(lambda: client.downloads)
    assert client.downloads.pop()[0] == "a.html"
    client.trigger("Dark or light")
    until(lambda: client.control("Dark").value)
    client.trigger("Dark or light")
    until(lambda: not client.control("Dark").value)
    assert client.control("Legend").value
    client.trigger("Legend")
    until(lambda: not client.control("Legend").value)
    client.trigger("Compare: draw both")
    until(lambda: "There is no B to draw; copy A to B first." in client.notifications)
    client.trigger("Compare: copy A to B")
    until(lambda: "<b>B</b> is shown" in client.text())
    client.trigger("Compare: draw both")
    until(lambda: client.control("Draw both").value)
    client.trigger("Compare: remove B")
    until(lambda: "<b>B</b> is shown" not in client.text())
