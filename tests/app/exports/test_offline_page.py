import json
import re
from dataclasses import replace

import numpy as np
import pytest

from app.analysis.comparison import Comparison
from app.analysis.estimates import Estimates
from app.browser.guarded_server import GuardedServer
from app.errors import InputError
from app.exports.drawn_pair import DrawnPairs
from app.exports.offline_page import MOST_FRAMES, offline_page
from app.scene.camera import Camera
from app.scene.settings import ViewSettings
from app.scene.views import SLANTED
from estimator import Parameters
from tests.app.fake_recordings import fake_opened, fake_recording


def page(
    opened,
    frames,
    progress=lambda _: None,
    settings=None,
    estimates=None,
    comparison=None,
    picked=None,
):
    parameters = Parameters(n=4)
    settings = settings or ViewSettings()
    estimates = estimates or Estimates()
    pairs = DrawnPairs(opened, parameters, estimates, comparison, picked)
    begin = frames[len(frames) // 2]
    return offline_page(pairs, frames, begin, settings, SLANTED, progress)


def said(made):
    """What the page says of its frames."""
    found = re.search(r'id="tofscope-frames">(.*?)</script>', made, re.S)
    assert found
    return json.loads(found[1])


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


def test_it_says_frame_and_time_of_each_picture_and_where_something_moves():
    content = said(page(fake_opened(), range(18, 23)))
    assert (content["begin"], content["last"]) == (2, 39)
    assert content["numbers"] == [18, 19, 20, 21, 22]
    np.testing.assert_allclose(content["seconds"], np.arange(18, 23) / 15, atol=1e-3)
    np.testing.assert_allclose(content["starts"], np.arange(5) / 15, atol=1e-3)
    assert max(content["moving"]) == 1
    assert "frame 18 of 39" in content["lines"][0]
    assert all(0 <= index < len(content["legends"]) for index in content["legend"])


def test_it_shows_what_the_app_shows():
    estimates, opened = Estimates(), fake_opened()
    shown = estimates.estimated(opened, 20, Parameters(n=4))
    both = Comparison(Parameters(n=8), both=True)
    assert shown.flow is not None
    picked = (shown, shown.flow.clusters[0].index)
    content = said(page(opened, range(19, 22), estimates=estimates, comparison=both, picked=picked))
    assert any("Flow of B" in legend for legend in content["legends"])
    assert any("Picked" in legend for legend in content["legends"])
    assert "A: paper n 4" in " ".join(content["lines"][1])


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
    pairs = DrawnPairs(fake_opened(), Parameters(), Estimates())
    offline_page(pairs, [6], 6, ViewSettings(), camera, lambda _: None)
    assert placed == [camera]
