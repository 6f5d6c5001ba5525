import json
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import Browser, Page

from app.command_line import main
from app.output.scratch import scratch_folder
from app.scene.settings import ViewSettings
from recordings import sample_paths
from tests.app import waiting
from tests.browser.conftest import NO_DRAWING
from tests.browser.tab import until
from tests.conftest import REPOSITORY
from tests.recordings.room import write_room

_NODES = """() => Object.entries(window.__viserSceneTree.getState())
  .filter(([name, node]) => node.message && node.effectiveVisibility !== false)
  .map(([name, node]) => [name, node.message.props.points ? node.message.props.points.length : 0])
"""


@pytest.fixture
def sample() -> Path:
    return next(path for path in sample_paths() if "sideways" in path.name)


Export = Callable[..., str]


@pytest.fixture
def export(capfd: pytest.CaptureFixture[str]) -> Export:
    """`tofscope export` as a function of its arguments that returns what is printed."""

    def run(*arguments: object) -> str:
        code = main(["export", *map(str, arguments)])
        said = capfd.readouterr()
        assert (code, said.err) == (0, "")
        return said.out

    return run


def nodes(page: Page) -> dict[str, int]:
    """{visible node: how many numbers its points are}."""
    return dict(page.evaluate(_NODES))


def test_an_offline_page_opens_from_disk_without_network_and_plays(
    chromium: Browser, sample: Path, tmp_path: Path, export: Export
):
    place = tmp_path / "page.html"
    export(sample, "--html", place)
    assert place.stat().st_size < 10e6
    context = chromium.new_context(viewport={"width": 700, "height": 500}, offline=True)
    context.add_init_script(NO_DRAWING)
    page = context.new_page()
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    page.goto(place.as_uri())
    page.wait_for_selector("canvas[data-engine]")
    page.wait_for_function(
        "() => Object.keys(window.__viserSceneTree.getState()).some(n => n.includes('panda_link7'))"
    )
    assert page.title() == f"{sample.stem} (simulated)"
    page.locator("#about summary").click()
    assert page.get_by_text("delta: 0.04").is_visible()

    # It stands still at a frame at which something moves, and says which.
    at, corner = page.locator("#tofscope-now"), page.locator("#tofscope-corner")
    assert at.inner_text() == "frame 22 of 36 · 1.47 s"
    assert "frame 22 of 36 · 1.47 s · Δt 0.533 s" in corner.inner_text()
    assert page.locator("#tofscope-ticks span").all_inner_texts()[:2] == ["0 s", "0.5 s"]
    until(page, lambda: nodes(page)["/fixed/flow"] > 60)
    ground = "document.querySelector('canvas[data-engine]')"
    assert page.evaluate(f"getComputedStyle({ground}).backgroundColor") == "rgb(246, 247, 250)"
    for key, frame in (("ArrowRight", 23), ("ArrowLeft", 22), ("End", 36), ("Home", 0)):
        page.keyboard.press(key)
        until(page, lambda frame=frame: at.inner_text().startswith(f"frame {frame} "))
    assert "frame 0 of 36" in corner.inner_text()

    clock = page.locator("input").first
    shown = {clock.input_value()}
    page.keyboard.press("Space")

    def plays() -> bool:
        shown.add(clock.input_value())
        return len(shown) > 5

    until(page, plays)
    clock.focus()  # to type there, for which it stands still
    page.wait_for_timeout(300)
    held = clock.input_value()
    page.wait_for_timeout(500)
    assert clock.input_value() == held
    clock.fill("1.4")  # where the object moves
    until(page, lambda: nodes(page)["/fixed/flow"] > 60)
    seen = nodes(page)
    assert seen["/fixed/static_target"] > 300
    assert sum(name.startswith("/fixed/frustums/") for name in seen) >= 24
    assert sum(name.startswith("/fixed/robot/") for name in seen) > 10
    clock.fill("0.1")
    until(page, lambda: nodes(page)["/fixed/flow"] == 0)
    page.wait_for_timeout(500)
    assert clock.input_value() == "0.1", "it goes on although it was set to a time"
    context.close()
    # Contents of the page itself have URLs, too; no request goes to a server.
    assert {url.partition(":")[0] for url in asked} <= {"file", "data", "blob"}


def test_pictures_are_made_without_a_browser_open(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, export: Export
):
    room, place = write_room(tmp_path / "room.mcap").path, tmp_path / "a.png"
    flags = ["--frame=11", "--size=400x240", "--n=6"]
    bare = ["--no-legend", "--no-corner-line", "--no-scale-bar"]
    said = export(room, *flags, *bare, "--screenshot", place)
    assert said == f"{place}: frame 11 of room, 400 x 240.\n"
    with Image.open(place) as picture:
        assert (picture.format, picture.mode, picture.size) == ("PNG", "RGB", (400, 240))
        assert picture.info["Recording"] == "room"
        assert picture.info["Frame"].startswith("11 of ")
        assert json.loads(picture.info["Parameters"])["n"] == 6
        pixels = np.asarray(picture).astype(int)
    white = (pixels == 255).all(axis=2)
    assert 0.3 < white.mean() < 0.99
    red, blue = pixels[..., 0], pixels[..., 2]
    flow = ViewSettings().palette.flow
    as_in_the_legend = (np.abs(pixels - flow) <= 12).all(axis=2)
    assert as_in_the_legend.sum() > 20, "there is no flow, or of another colour than its legend's"
    assert (blue > red + 60).sum() > 30, "there is no target"

    # On nothing, with another view beside it, where the path of temporary files is long.
    long = tmp_path / (150 * "a")
    long.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(long))
    said = export(room, *flags, "--transparent", "--view", "3d", "top", "--screenshot", place)
    assert said.endswith("800 x 240.\n")
    assert not list(long.iterdir())
    with Image.open(place) as picture:
        assert (picture.mode, picture.size) == ("RGBA", (800, 240))
        left, right = picture.crop((0, 0, 390, 150)), picture.crop((410, 0, 800, 150))
        between = np.asarray(picture.crop((398, 0, 402, 150)))
    assert (between[..., 3] == 0).all(), "there is no gap"
    for view in (left, right):
        assert 0.005 < (np.asarray(view)[..., 3] == 255).mean() < 0.7
    assert left.tobytes() != right.tobytes()


def test_figures_videos_and_images_have_their_size_and_say_what_they_show(
    tmp_path: Path, export: Export
):
    room, place = write_room(tmp_path / "room.mcap").path, tmp_path / "a.png"
    flags = ["--frame=11", "--n=6", "--size-mm=88x60", "--dpi=150", "--view", "3d", "top"]
    said = export(room, *flags, "--screenshot", place)
    assert said == f"{place}: frame 11 of room, 88 mm x 60 mm, 520 x 354 pixels.\n"
    with Image.open(place) as picture:
        assert picture.size == (520, 354)
        assert round(picture.info["dpi"][0]) == 150
        pixels = np.asarray(picture).astype(int)
    flow = ViewSettings().palette.flow
    assert (np.abs(pixels[:250] - flow) <= 12).all(axis=2).sum() > 20, "there is no flow"
    assert (pixels[-60:] < 100).all(axis=2).sum() > 100, "there is no corner line"

    flags = ["--frames=10:12", "--n=6", "--size=320x240", "--view", "3d", "top"]
    said = export(room, *flags, "--speed=0.5", "--video", tmp_path / "a.gif")
    assert said.startswith(f"{tmp_path / 'a.gif'}: frames 10 to 12 of room, ")
    with Image.open(tmp_path / "a.gif") as picture:
        assert (picture.size, getattr(picture, "n_frames", 1)) == ((320, 240), 3)
    said = export(room, *flags, "--images", tmp_path / "images")
    assert said.endswith("frames 10 to 12 of room, each 320 x 240.\n")
    names = sorted(path.name for path in (tmp_path / "images").iterdir())
    assert names == [f"frame_{k:06d}.png" for k in (10, 11, 12)]
    with Image.open(tmp_path / "images" / names[1]) as picture:
        assert picture.info["Frame"].startswith("11 of ")


def drawing_in(folder: Path) -> list[str]:
    """Commands of the processes that have to do with a folder."""
    found: list[str] = []
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        with suppress(OSError):
            command = path.read_bytes().replace(b"\0", b" ").decode(errors="replace")
            found += [command] if f"--user-data-dir={folder}" in command else []
    return found


@pytest.fixture
def scratch() -> Iterator[Path]:
    """A folder with a path that is short enough for Chromium."""
    with tempfile.TemporaryDirectory(dir="/tmp") as folder:
        yield Path(folder)


def test_an_export_that_is_ended_leaves_no_chromium_and_no_files(tmp_path: Path, scratch: Path):
    out = tmp_path / "out"
    out.mkdir()
    room = write_room(tmp_path / "room.mcap").path
    asked = ["export", str(room), "--screenshot", str(out / "a.png")]
    running: dict[signal.Signals, tuple[Path, subprocess.Popen[bytes]]] = {}
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
        folder = scratch / str(int(number))
        folder.mkdir()
        process = subprocess.Popen(
            [sys.executable, "-m", "app", *asked],
            env=os.environ | {"PYTHONPATH": str(REPOSITORY), "TMPDIR": str(folder)},
            stderr=subprocess.PIPE,
        )
        running[number] = folder, process
    for number, (folder, process) in running.items():
        # It, and processes of its own.
        waiting.until(lambda folder=folder: len(drawing_in(folder)) > 2, 60)
        process.send_signal(number)
    for number, (folder, process) in running.items():
        _, said = process.communicate(timeout=20)
        assert said == b""
        assert process.returncode == (-number if number == signal.SIGKILL else 130)
        waiting.until(lambda folder=folder: not drawing_in(folder))
        if number == signal.SIGKILL:
            with scratch_folder(folder):
                pass  # the next command removes what a killed one leaves
        assert not list(folder.iterdir())
    assert not list(out.iterdir())
