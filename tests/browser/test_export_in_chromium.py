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
from tests.browser.tab import Tab, until
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
    page.get_by_text(f"{sample.stem} (simulated)").click()
    assert page.get_by_text("delta: 0.04").is_visible()

    clock = page.locator("input").first
    shown = {clock.input_value()}

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


def test_pictures_are_made_without_a_browser_open(tmp_path: Path, export: Export):
    room, place = write_room(tmp_path / "room.mcap").path, tmp_path / "a.png"
    flags = ["--frame=11", "--size=400x240", "--n=6"]
    said = export(room, *flags, "--screenshot", place)
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

    # The same again, on nothing and with another view beside it.
    flags += ["--transparent", "--view", "3d", "top"]
    said = export(room, *flags, "--screenshot", place)
    assert said.endswith("800 x 240.\n")
    with Image.open(place) as picture:
        assert (picture.mode, picture.size) == ("RGBA", (800, 240))
        left, right = picture.crop((0, 0, 400, 240)), picture.crop((400, 0, 800, 240))
    ground = Image.new("RGBA", left.size, "white")
    ground.alpha_composite(left)
    np.testing.assert_array_equal(np.asarray(ground.convert("RGB")), pixels)
    for view in (left, right):
        assert 0.005 < (np.asarray(view)[..., 3] == 255).mean() < 0.7
    assert left.tobytes() != right.tobytes()


def test_the_app_makes_an_offline_page_while_the_session_goes_on(tab: Tab):
    frame = tab.value("Frame")
    with tab.page.expect_download() as download:
        tab.page.get_by_role("button", name="Save offline page").click()
        tab.set_slider("Frame", "ArrowLeft", times=2)
    assert tab.value("Frame") == frame - 2
    name = download.value.suggested_filename
    assert name.endswith(".html")
    tab.until(lambda: tab.has_text(f"{name}, "))
    page = Path(download.value.path()).read_text()
    assert f"<title>{name.removesuffix('.html')} (simulated)</title>" in page
    assert "__VISER_EMBED_DATA__" in page


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


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_an_export_that_is_ended_leaves_no_chromium_and_no_files(
    number: int, tmp_path: Path, scratch: Path
):
    out = tmp_path / "out"
    out.mkdir()
    room = write_room(tmp_path / "room.mcap").path
    asked = ["export", str(room), "--screenshot", str(out / "a.png")]
    process = subprocess.Popen(
        [sys.executable, "-m", "app", *asked],
        env=os.environ | {"PYTHONPATH": str(REPOSITORY), "TMPDIR": str(scratch)},
        stderr=subprocess.PIPE,
    )
    waiting.until(lambda: len(drawing_in(scratch)) > 2, 30)  # it, and processes of its own
    process.send_signal(number)
    _, said = process.communicate(timeout=20)
    assert said == b""
    assert process.returncode == (-number if number == signal.SIGKILL else 130)
    waiting.until(lambda: not drawing_in(scratch))
    if number == signal.SIGKILL:
        with scratch_folder(scratch):
            pass  # the next command removes what a killed one leaves
    assert not list(scratch.iterdir())
    assert not list(out.iterdir())


def test_a_long_path_of_temporary_files_does_not_matter(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, export: Export
):
    room = write_room(tmp_path / "room.mcap").path
    long = tmp_path / (150 * "a")
    long.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(long))
    export(room, "--screenshot", tmp_path / "a.png", "--size", "64x64", "--frame", 11)
    assert not list(long.iterdir())
