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
    # The page is dark as the system is, afterwards, too.
    client.tell("system", {"dark": True})
    until(lambda: client.control("Dark").value)


def rendered(client, asked):
    """Let the client render nothing, and note the sizes of the pictures and of points."""

    def render(height, width, **_):
        asked.append((width, height, client.node(f"{FIXED}/source").point_size))
        return np.zeros((height, width, 4), dtype=np.uint8)

    client.get_render = render


def test_views_of_a_size_are_one_picture_that_says_what_it_shows(session, client):
    client.change("Size", "1280 x 720")
    client.change("Views", "Slanted and from above")
    asked = []
    rendered(client, asked)
    before = client.node(f"{FIXED}/source").point_size
    client.press("Save screenshot")
    until(lambda: client.downloads)
    name, content = client.downloads[0]
    assert name == "a_frame_0024_slanted_from_above.png"
    picture = Image.open(io.BytesIO(content))
    assert picture.size == (2560, 720)
    assert picture.info["Recording"] == "a"
    assert picture.info["Frame"].startswith("24 of 39")
    assert from_text(picture.info["Parameters"], name) == Parameters()
    large = [size for size in asked if size[0] > 8]
    assert len(large) == 2
    assert large[0][:2] == large[1][:2]
    assert 1200 < large[0][0] < 1280, "there is no gap between the views"
    # The window is 60 pixels high: in a larger picture points have to be as much larger.
    assert asked[-1][2] > 3 * before
    until(lambda: client.node(f"{FIXED}/source").point_size == pytest.approx(before))
    assert len(points(client, "source")) + len(points(client, "static_source")) == 500


def test_a_figure_for_print_has_its_size_on_paper_in_a_picture_and_in_a_drawing(session, client):
    client.change("Size", "88 x 62 mm")
    client.change("dpi", 600)
    rendered(client, [])
    client.press("Save screenshot")
    until(lambda: client.downloads)
    picture = Image.open(io.BytesIO(client.downloads.pop()[1]))
    assert picture.size == (2079, 1465)
    assert picture.info["dpi"][0] == pytest.approx(600, rel=1e-3)
    client.press_option("Vector", "SVG")
    until(lambda: client.downloads)
    name, content = client.downloads.pop()
    assert name == "a_frame_0024.svg"
    assert b'width="249.4' in content
    assert b"True displacement" in content


def test_an_own_size_that_cannot_be_drawn_is_refused(session, client):
    client.change("Size", "Own size, mm")
    client.change("Own width", 3000)
    for button in ("PDF", "SVG"):
        client.press_option("Vector", button)
        until(lambda: any("must be 10 to 1000 mm, got 3000" in n for n in client.notifications))
    client.press("Save screenshot")
    assert not client.downloads


def test_the_flow_of_a_frame_and_of_the_range_are_files(session, client):
    client.press_option("Flow data", "CSV")
    until(lambda: client.downloads)
    name, content = client.downloads.pop()
    assert name == "a_frame_0024_flow.csv"
    assert content.decode().splitlines()[3].startswith("x,y,z,vx,vy,vz,label,cluster,sensor,zone")
    client.press_option("Flow of range", "NPZ")
    until(lambda: client.downloads)
    name, content = client.downloads.pop()
    assert name == "a_frames_0000_0039_flow.npz"
    with np.load(io.BytesIO(content)) as arrays:
        np.testing.assert_array_equal(arrays["frames"], range(8, 40))


def test_a_video_of_the_range_is_made_in_the_background(session, client, monkeypatch):
    made = []

    def video(animation, kind, speed, estimates, progress):
        made.append((list(animation.frames), kind, speed, animation.figure.views))
        progress(0)
        return b"GIF89a"

    monkeypatch.setattr("app.panels.figure_exports.video", video)
    client.change("Views", "From above")
    client.press_option("Video", "GIF")
    until(lambda: client.downloads)
    assert client.downloads == [("a_frames_0000_0039.gif", b"GIF89a")]
    assert made == [(list(range(40)), "gif", 1.0, ("From above",))]


def test_saved_parameters_are_those_in_use(session, client):
    client.change("δ", 0.3)
    client.press("Save parameters as a file")
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
    assert Image.open(io.BytesIO(client.downloads[1][1])).getpixel((5, 5)) == (22, 24, 28)


def test_a_screenshot_that_fails_is_told(session, client):
    client.render = TimeoutError("no frame")
    client.press("Save screenshot")
    until(lambda: any("The browser gave no picture" in n for n in client.notifications))


def test_an_export_goes_on_when_another_recording_is_opened(session, client, shared, runs):
    runs.delay = 0.05
    client.press("Save offline page")
    until(lambda: "Drawing frame by frame." in client.notifications)
    start = time.monotonic()
    client.choose("b")
    until(lambda: client.recording() == "b" and "Moving" in client.text())
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
