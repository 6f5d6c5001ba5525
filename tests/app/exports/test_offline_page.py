from dataclasses import replace

import numpy as np
import pytest

from app.analysis.estimates import Estimates
from app.browser.guarded_server import GuardedServer
from app.errors import InputError
from app.exports.offline_page import MOST_FRAMES, offline_page
from app.scene.camera import Camera
from app.scene.settings import ViewSettings
from app.scene.views import SLANTED
from estimator import Parameters
from tests.app.fake_recordings import fake_opened, fake_recording


def page(opened, frames, progress=lambda _: None, settings=None, estimates=None):
    parameters = Parameters(n=4)
    settings = settings or ViewSettings()
    estimates = estimates or Estimates()
    return offline_page(opened, frames, parameters, settings, SLANTED, estimates, progress)


def test_it_says_what_it_shows():
    recording = fake_recording(name="a <b>")
    made = page(fake_opened(recording), range(5, 8))
    assert "<title>a &lt;b&gt;</title>" in made
    assert "n: 4, gamma: 0.7" in made
    assert "5 to 7 of 39" in made
    assert "measured" in made
    recording.simulated = True
    assert "<title>a &lt;b&gt; (simulated)</title>" in page(fake_opened(recording), [5])


def test_it_pauses_as_the_stamps_say(monkeypatch):
    pauses = []
    monkeypatch.setattr(
        "viser.infra.StateSerializer.insert_sleep", lambda _, seconds: pauses.append(seconds)
    )
    recording = fake_recording()
    recording.stamps = np.delete(np.arange(42) / 10, [6, 7])
    page(fake_opened(recording), range(3, 8))
    np.testing.assert_allclose(pauses, [0.1, 0.1, 0.3, 0.1, 0.1])


def test_it_is_dark_where_the_app_is():
    dark = page(fake_opened(), [6], settings=replace(ViewSettings(), dark=True))
    assert "__VISER_EMBED_CONFIG__={darkMode:true}" in dark
    assert "__VISER_EMBED_CONFIG__={darkMode:false}" in page(fake_opened(), [6])


def test_it_can_be_ended_and_gives_back_its_server(monkeypatch):
    stopped, stop = [], GuardedServer.stop
    monkeypatch.setattr(GuardedServer, "stop", lambda server: stopped.append(stop(server)))
    drawn = []

    def progress(index):
        drawn.append(index)
        if index == 2:
            raise InterruptedError

    with pytest.raises(InterruptedError):
        page(fake_opened(), range(10), progress)
    assert drawn == [0, 1, 2]
    assert len(stopped) == 1


def test_too_many_frames_are_refused_before_anything_is_drawn():
    with pytest.raises(InputError, match="too many for one page, which holds 3000"):
        page(fake_opened(), range(MOST_FRAMES + 1), lambda _: pytest.fail("drawn"))


def test_it_is_seen_from_where_it_is_told(monkeypatch):
    placed = []
    monkeypatch.setattr("app.scene.scene.Scene.set_camera", lambda _, camera: placed.append(camera))
    camera = Camera((3.0, 2.0, 1.0), (0.0, 0.0, 0.5), 0.6)
    offline_page(
        fake_opened(), [6], Parameters(), ViewSettings(), camera, Estimates(), lambda _: None
    )
    assert placed == [camera]
