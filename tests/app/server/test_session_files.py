"""Files that a session sends: pictures, parameters, offline pages."""

import io
import threading
import time

import numpy as np
import pytest
from PIL import Image

from app.analysis.parameter_files import from_text
from app.scene.arrows import linear
from app.scene.palettes import PAPER, palette
from app.scene.scene_root import FIXED
from app.server.session import Session
from estimator import Parameters
from tests.app.drawn import points
from tests.app.waiting import until


def test_a_screenshot_is_named_after_recording_and_frame(session, client):
    client.press("Save screenshot")
    until(lambda: client.downloads)
    name, content = client.downloads[0]
    assert name == "a_frame_0024.png"
    assert content.startswith(b"\x89PNG")


def test_both_views_of_a_size_are_one_picture_that_says_what_it_shows(session, client):
    client.change("Size", "1280 x 720")
    client.change("Scale", "2x")
    asked = []

    def render(height, width, **_):
        asked.append((width, height, client.node(f"{FIXED}/source").point_size))
        return np.zeros((height, width, 4), dtype=np.uint8)

    client.get_render = render
    before = client.node(f"{FIXED}/source").point_size
    client.press("Save 3D and top view")
    until(lambda: client.downloads)
    name, content = client.downloads[0]
    assert name == "a_frame_0024_3d_top.png"
    picture = Image.open(io.BytesIO(content))
    assert picture.size == (2 * 2560, 1440)
    assert picture.info["Recording"] == "a"
    assert picture.info["Frame"].startswith("24 of 39")
    assert from_text(picture.info["Parameters"], name) == Parameters()
    assert [a[:2] for a in asked if a[0] > 8] == [(2560, 1440)] * 2
    # The window is 60 pixels high: in a larger picture points have to be as much larger.
    assert asked[-1][2] > 10 * before
    until(lambda: client.node(f"{FIXED}/source").point_size == pytest.approx(before))
    assert len(points(client, "source")) + len(points(client, "static_source")) == 500


def test_saved_parameters_are_those_in_use(session, client):
    client.change("δ", 0.3)
    client.press("Save as a file")
    until(lambda: client.downloads)
    name, content = client.downloads[0]
    assert name == "parameters.json"
    assert from_text(content.decode(), name) == Parameters(delta=0.3)


def test_a_white_picture_of_a_dark_page_has_the_colours_for_white(session, client):
    client.change("Dark", True)
    client.change("With legend", False)
    client.change("Background", "White")
    flow = f"{FIXED}/flow"
    white, dark = (tuple(linear(np.array(palette(PAPER, dark=d).flow))) for d in (False, True))

    def colour():
        return tuple(client.node(flow).colors[0, 0])

    until(lambda: colour() == dark)
    seen = []

    def render(height, width, **_):
        seen.append(colour())
        return np.zeros((height, width, 4), dtype=np.uint8)

    client.get_render = render
    client.press("Save screenshot")
    until(lambda: client.downloads)
    assert set(seen) == {white}
    until(lambda: colour() == dark)
    assert Image.open(io.BytesIO(client.downloads[0][1])).getpixel((5, 5)) == (255, 255, 255)
    client.change("Background", "As on the screen")
    client.press("Save screenshot")
    until(lambda: len(client.downloads) == 2)
    assert seen[-1] == dark
    assert Image.open(io.BytesIO(client.downloads[1][1])).getpixel((5, 5)) == (20, 20, 20)


def test_a_screenshot_that_fails_is_told(session, client):
    client.render = TimeoutError("no frame")
    client.press("Save screenshot")
    until(lambda: any("The browser gave no picture" in n for n in client.notifications))


def test_an_export_goes_on_when_another_recording_is_opened(session, client, shared, runs):
    runs.delay = 0.05
    client.press("Save offline page")
    until(lambda: "Drawing frame by frame." in client.notifications)
    start = time.monotonic()
    client.change("Recording", "b")
    until(lambda: client.control("Recording").value == "b" and "Frame" in client.text())
    until(lambda: len(shared.library._shared) == 2)
    assert time.monotonic() - start < 5
    until(lambda: client.downloads)
    assert client.downloads[0][0] == "a.html"
    until(lambda: [entry.label for entry in shared.library._shared] == ["b"])


def test_the_end_of_a_session_ends_its_export(client, shared, runs):
    session = Session(client, shared)
    until(lambda: "Moving" in client.text())
    runs.delay = 0.1
    client.press("Save offline page")
    until(lambda: "Drawing frame by frame." in client.notifications)
    start = time.monotonic()
    session.close()
    session.join(10)
    assert time.monotonic() - start < 5
    until(lambda: "offline page" not in [thread.name for thread in threading.enumerate()])
    assert client.downloads == []
    assert shared.library._shared == {}
