"""Sessions restored by reloading a page or opening a link."""

import re

import numpy as np
import pytest
from viser._messages import RunJavascriptMessage, ThemeConfigurationMessage

from app.analysis.comparison import B, Comparison
from app.scene.camera import Camera
from app.scene.palettes import COLOUR_BLIND
from app.scene.scene_root import FIXED
from app.scene.settings import LAYERS, ViewSettings
from app.server.session import Session
from app.session.links import SavedSession, from_token
from estimator import Parameters
from tests.app.drawn import shown_frame
from tests.app.fake_client import FakeClient, FakeStorage
from tests.app.waiting import until


def test_a_reload_finds_what_it_left_and_a_second_tab_begins_anew(session, client, shared, runs):
    client.choose("b")
    client.change("δ", 0.3)
    client.tell("seek", {"frame": 33})
    until(lambda: shown_frame(client) == 33 and runs.parameters[-1].delta == 0.3)
    with FakeClient.on_a_server(client.local_storage) as tab:
        other = Session(tab, shared)
        until(lambda: "Moving" in tab.text())
        assert tab.control("δ").value == 0.04
        assert tab.recording() == "a"
        other.close()
        other.join(10)


def test_a_reload_restores(client, shared, runs):
    session = Session(client, shared)
    until(lambda: "Moving" in client.text())
    client.choose("b")
    client.change("δ", 0.3)
    until(lambda: runs.parameters[-1].delta == 0.3)
    client.tell("seek", {"frame": 33})
    until(lambda: shown_frame(client) == 33)
    session.close()
    session.join(10)
    with FakeClient.on_a_server(client.local_storage) as again:
        session = Session(again, shared)
        until(lambda: shown_frame(again) == 33)
        assert again.recording() == "b"
        assert again.control("δ").value == 0.3
        session.close()
        session.join(10)


def test_a_reload_restores_camera_and_view_too(client, shared, runs):
    session = Session(client, shared)
    until(lambda: "Moving" in client.text())
    client.change("Arrow scale", 1.5)
    client.change("Robot", False)
    client.change("Dark", True)
    until(lambda: not client.node(f"{FIXED}/robot").visible)
    themes = ThemeConfigurationMessage
    until(lambda: any(m.dark_mode for m in client.sent if isinstance(m, themes)))
    client.camera.position, client.camera.look_at = np.array([5.0, 6.0, 7.0]), np.ones(3)
    session.close()
    session.join(10)
    with FakeClient.on_a_server(client.local_storage) as again:
        session = Session(again, shared)
        until(lambda: "Moving" in again.text())
        assert again.control("Arrow scale").value == 1.5
        assert again.control("Dark").value
        assert not again.node(f"{FIXED}/robot").visible
        np.testing.assert_allclose(again.camera.position, [5.0, 6.0, 7.0])
        again.choose("b")  # which is seen as it is seen first
        until(lambda: not np.allclose(again.camera.position, [5.0, 6.0, 7.0]))
        session.close()
        session.join(10)


def test_a_reload_restores_playback_and_comparison(client, shared, runs):
    session = Session(client, shared)
    until(lambda: "Moving" in client.text())
    client.tell("playback", {"speed": 0.5, "loop": False})
    client.tell("playback", {"first": 5, "last": 30})
    client.tell("strip", {"name": "speed"})
    client.press("Copy A to B")
    until(lambda: "<b>B</b> is shown" in client.text())
    client.change("δ", 0.3)
    until(lambda: runs.parameters[-1].delta == 0.3)
    session.close()
    session.join(10)
    with FakeClient.on_a_server(client.local_storage) as again:
        session = Session(again, shared)
        until(lambda: "<b>B</b> is shown" in again.text())
        until(lambda: again.shown("timeline.quantity"))
        assert again.shown("timeline.playback") == [
            {"playing": False, "first": 5, "last": 30, "speed": 0.5, "loop": False}
        ]
        assert again.shown("timeline.quantity")[0]["chosen"] == "speed"
        assert again.control("δ").value == 0.3
        again.press("Switch to A")
        until(lambda: again.control("δ").value == 0.04)
        session.close()
        session.join(10)


def arrive(client, shared, token):
    """A session whose page was opened with a link."""
    client.link = token
    session = Session(client, shared)
    until(lambda: "Moving" in client.text() or "No pair" in client.text())
    session.close()
    session.join(10)


def test_a_link_leads_to_recording_frame_camera_and_parameters(client, shared, runs):
    camera = Camera((1.0, 2.0, 3.0), (0.5, 0.25, 0.0), 0.7)
    arrive(client, shared, SavedSession("b", 31, Parameters(n=5, delta=0.01), camera).token())
    assert client.recording() == "b"
    assert shown_frame(client) == 31
    assert set(runs.parameters) == {Parameters(n=5, delta=0.01)}
    assert tuple(client.camera.position) == camera.position
    assert tuple(client.camera.look_at) == camera.look_at
    assert set(client.local_storage.items) == {"session"}
    # What was left is found again, and not the link.
    with FakeClient.on_a_server(client.local_storage) as again:
        session = Session(again, shared)
        until(lambda: shown_frame(again) == 31)
        session.close()
        session.join(10)


class SlowStorage(FakeStorage):
    """Storage of a page that answers after so many seconds."""

    def __init__(self, seconds):
        super().__init__()
        self.seconds = seconds

    def get_item(self, key, timeout=None):
        if timeout is not None and timeout < self.seconds:
            raise TimeoutError
        return super().get_item(key, timeout)


def test_a_busy_page_is_waited_for_and_a_silent_one_is_told(shared, runs):
    token = SavedSession("b", 31, Parameters(n=5, delta=0.01)).token()
    with FakeClient.on_a_server(SlowStorage(30)) as busy:
        arrive(busy, shared, token)
        assert (busy.recording(), shown_frame(busy)) == ("b", 31)
        assert not busy.notifications
    with FakeClient.on_a_server(SlowStorage(1e6)) as silent:
        arrive(silent, shared, token)
        assert silent.recording() == "a"
        assert any("reload it to try again" in said for said in silent.notifications)


def test_a_link_leads_to_the_whole_comparison_the_view_and_the_picked_cluster(client, shared, runs):
    view = ViewSettings(colours=COLOUR_BLIND, layers=frozenset(LAYERS) - {"Robot"})
    comparison = Comparison(Parameters(method="baseline"), edited=B, both=True)
    saved = SavedSession(
        *("b", 31, Parameters(n=5)),
        settings=view,
        comparison=comparison,
        picked=2,
        plotted_pair=("moving", "angle_deg"),
    )
    client.link = saved.token()
    session = Session(client, shared)
    until(lambda: "<b>B</b> is shown" in client.text(), timeout=30)
    until(lambda: "n: 8 → 5" in client.text())
    assert "method: baseline → paper" in client.text()
    assert client.control("Draw both").value
    until(lambda: client.control("Plot").value == "Angle deviation [°]")
    assert client.control("against").value == "Moving points"
    until(lambda: client.control("Cluster").value.startswith("2 "))
    assert not client.control("Robot").value
    assert client.control("Frustums").value
    session.close()
    session.join(10)


@pytest.mark.parametrize(
    ("token", "sentence"),
    [
        ("nonsense", "The link is damaged"),
        # {"recording":"\\ud800","frame":0,"parameters":{}}
        (
            "eyJyZWNvcmRpbmciOiJcdWQ4MDAiLCJmcmFtZSI6MCwicGFyYW1ldGVycyI6e319",
            "The link is damaged",
        ),
        (
            SavedSession("zz", 3, Parameters(n=5, delta=0.01)).token(),
            "The recording zz is not among those",
        ),
    ],
)
def test_a_link_that_leads_nowhere_is_told(client, shared, runs, token, sentence):
    arrive(client, shared, token)
    assert any(sentence in said for said in client.notifications)
    assert client.recording() == "a"
    assert set(runs.parameters) == {Parameters()}


def test_whatever_fails_on_the_way_a_session_begins(client, shared, runs, monkeypatch):
    def fail(_):
        raise ZeroDivisionError

    monkeypatch.setattr("app.server.session.from_token", fail)
    arrive(client, shared, "anything")
    assert client.notifications == [
        "What this page showed before could not be found; it begins anew."
    ]
    assert set(client.local_storage.items) == {"session"}  # the link is gone for good


@pytest.mark.parametrize("kept", ["", "x" * 1_000_000, "\udfff", "[" * 1000, "0"])
def test_whatever_a_tab_keeps_a_session_begins(client, shared, runs, kept):
    client.local_storage.set_item("session", kept)
    client.local_storage.set_item("link", kept)  # that nothing reads
    session = Session(client, shared)
    until(lambda: "Moving" in client.text())
    session.close()
    session.join(10)
    assert not client.notifications


def test_the_link_that_is_copied_leads_here(session, client):
    client.change("δ", 0.3)
    client.tell("seek", {"frame": 30})
    until(lambda: shown_frame(client) == 30)
    client.take_sent()
    client.press("Copy link")
    until(lambda: client.notifications)
    scripts = [m.source for m in client.take_sent() if isinstance(m, RunJavascriptMessage)]
    (token,) = re.findall(r"\?link=([\w-]+)`", "".join(scripts))
    saved = from_token(token)
    assert (saved.label, saved.frame, saved.parameters.delta) == ("a", 30, 0.3)
    assert saved.camera == session_camera(client)


def session_camera(client):
    camera = client.camera
    position, look_at = (tuple(np.round(v, 4).tolist()) for v in (camera.position, camera.look_at))
    return Camera(position, look_at, round(camera.fov, 4))
