import io
import zipfile
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from app.analysis.comparison import Comparison
from app.analysis.estimates import Estimates
from app.errors import InputError
from app.exports import animation
from app.exports.animation import Animation
from app.exports.ffmpeg import find_ffmpeg, mp4
from app.exports.figure_settings import FigureSettings
from app.exports.figure_size import FigureSize
from app.exports.images import zipped_pictures
from app.exports.video import GIF, MP4, counts, ticks, video
from app.scene.settings import ViewSettings
from app.scene.views import ABOVE, SLANTED
from estimator import Parameters
from tests.app.fake_recordings import fake_opened, fake_recording


class Browser:
    """Stands in for a headless browser: pictures of one colour, a new one each time."""

    def __init__(self):
        self.shown, self.cameras = [], []

    def __call__(self, recording, settings, width, height, detail):
        self.size = width, height
        return self

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.closed = True

    @property
    def legend(self):
        return self.shown[-1].legend(ViewSettings())

    def show(self, drawn):
        self.shown.append(drawn)

    def settled(self, camera):
        self.cameras.append(camera)
        width, height = self.size
        colour = (12 * len(self.shown) % 256, 100, 50, 255)
        return np.full((height, width, 4), colour, dtype=np.uint8)

    rendered = settled


@pytest.fixture
def browser(monkeypatch) -> Browser:
    browser = Browser()
    monkeypatch.setattr(animation, "headless_scene", browser)
    return browser


def moving(frames=range(16, 22), views=(SLANTED,), size=(241, 181), recording=None) -> Animation:
    figure = FigureSettings(FigureSize.in_pixels(*size), views, legend=False)
    return Animation(fake_opened(recording), frames, Parameters(), ViewSettings(), figure)


def test_times_follow_the_stamps_and_do_not_drift():
    assert counts([1 / 15] * 15, 30) == [2] * 15
    assert counts([0.1, 0.1, 0.4], 30) == [3, 3, 12]
    jitter = [0.0667, 0.0601, 0.0732, 0.0667] * 50
    assert sum(counts(jitter, 30)) == round(30 * sum(jitter))
    assert abs(sum(ticks(jitter)) - 100 * sum(jitter)) < 1
    assert counts([0.001], 30) == [1]
    assert min(ticks([0.001] * 5)) == 2


def test_a_gif_shows_each_frame_as_long_as_it_lasted(browser):
    done = []
    recording = fake_recording()
    recording.stamps = np.delete(np.arange(42) / 10, [18, 19])
    content = video(moving(recording=recording), GIF, 0.5, Estimates(), done.append)
    with Image.open(io.BytesIO(content)) as picture:
        assert picture.size == (241, 181)
        assert b"Made with Tofscope" in picture.info["comment"]
        assert b"measured" in picture.info["comment"]
        lasting = []
        for index in range(getattr(picture, "n_frames", 1)):
            picture.seek(index)
            lasting.append(picture.info["duration"])
    assert lasting == [200, 600, 200, 200, 200, 200]
    assert done == list(range(6))
    assert [drawn.pair.frame for drawn in browser.shown] == list(range(16, 22))
    assert browser.closed


def test_the_camera_is_still_or_goes_from_view_to_view(browser):
    list(moving().pictures(Estimates(), lambda _: None))
    assert len({camera.position for camera in browser.cameras}) == 1
    still = browser.cameras[0]
    browser.cameras.clear()
    list(moving(views=(SLANTED, ABOVE)).pictures(Estimates(), lambda _: None))
    assert len({camera.position for camera in browser.cameras}) == 6
    np.testing.assert_allclose(browser.cameras[0].position, still.position, atol=1e-9)
    above = np.subtract(browser.cameras[-1].position, browser.cameras[-1].look_at)
    assert above[2] > 100 * np.hypot(*above[:2])


def test_an_animation_shows_what_the_app_shows(browser):
    estimates, opened = Estimates(), fake_opened()
    shown = estimates.estimated(opened, 18, Parameters())
    assert shown.flow is not None
    index = shown.flow.clusters[0].index
    both = Comparison(Parameters(n=4), both=True)
    list(
        replace(moving(), comparison=both, picked=(shown, index)).pictures(
            estimates, lambda _: None
        )
    )
    assert all(drawn.second.interval == pytest.approx(4 / 15) for drawn in browser.shown)
    assert all(drawn.side == "A" for drawn in browser.shown)
    followed = {drawn.pair.frame: drawn.picked for drawn in browser.shown}
    assert followed[18] is not None
    assert followed[18].index == index


def test_pictures_are_numbered_in_a_zip_file(browser):
    content = zipped_pictures(moving(), Estimates(), lambda _: None)
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        assert archive.namelist() == [f"frame_{k:06d}.png" for k in range(16, 22)]
        with Image.open(archive.open("frame_000017.png")) as picture:
            assert picture.info["Frame"].startswith("17 of ")
    assert browser.closed


def test_an_animation_can_be_ended(browser):
    def progress(index):
        if index == 2:
            raise InterruptedError

    with pytest.raises(InterruptedError):
        video(moving(), GIF, 1.0, Estimates(), progress)
    assert browser.closed
    assert len(browser.shown) == 2


def test_an_mp4_file_says_what_it_is_and_has_even_sides(browser):
    content = video(moving(), MP4, 1.0, Estimates(), lambda _: None)
    assert content[4:8] == b"ftyp"
    assert b"Made with Tofscope" in content
    assert b"avc1" in content
    # The track's size, in 16.16 fixed point.
    assert (242 << 16).to_bytes(4, "big") + (182 << 16).to_bytes(4, "big") in content


def test_without_ffmpeg_it_says_how_to_get_one(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setitem(__import__("sys").modules, "imageio_ffmpeg", None)
    with pytest.raises(InputError, match=r"apt-get install ffmpeg.*pip install imageio-ffmpeg"):
        find_ffmpeg()


def test_an_ffmpeg_that_fails_is_one_sentence(tmp_path, monkeypatch):
    fake = tmp_path / "ffmpeg"
    fake.write_text("#!/bin/sh\necho 'Unknown encoder libx264' >&2\nexit 1\n")
    fake.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    picture = Image.new("RGB", (640, 480))
    with pytest.raises(InputError, match=r"made no MP4 file \(Unknown encoder libx264\)"):
        mp4([(picture, 3)], 30, {"title": "a"})
