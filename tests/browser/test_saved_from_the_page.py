"""Files that a person saves from the page: of the right kind and size, with what the page shows."""

import csv
import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from playwright.sync_api import Download, Locator

from app.exports.ffmpeg import find_ffmpeg
from app.scene.settings import ViewSettings
from estimator import Label
from tests.browser.tab import Tab
from tests.browser.test_timeline_in_chromium import RANGE, drag
from tests.browser.test_what_moves_in_chromium import from_each

_INCH = 72  # points
_FACT = """name => [...document.querySelectorAll("span")].find(
  span => span.textContent === name && span.nextElementSibling)?.nextElementSibling.textContent"""
_SIZE = (320, 240)  # pixels of a video


def group(tab: Tab, label: str) -> Locator:
    """The row of buttons with this label."""
    text = tab.page.get_by_text(label, exact=True).first
    return text.locator("xpath=ancestor::*[.//button][1]")


def saved(tab: Tab, label: str, kind: str) -> Download:
    """What a button of a row saves."""
    with tab.page.expect_download(timeout=120_000) as download:
        group(tab, label).get_by_role("button", name=kind, exact=True).click()
    return download.value


def page_of(pdf: bytes) -> list[float]:
    """Width and height in points of a PDF file's page."""
    found = re.search(rb"/MediaBox ?\[ ?0 0 ([\d.]+) ([\d.]+) ?\]", pdf)
    assert found is not None
    return [float(side) for side in found.groups()]


def fact(tab: Tab, name: str) -> int:
    """A number of the pair, as the page says it."""
    return int(tab.page.evaluate(_FACT, name))


def rows_of(path: Path) -> list[dict[str, str]]:
    """Rows of a CSV file without its comments."""
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


def play_only(tab: Tab, start: float, end: float) -> range:
    """Drag the ends of the range that is played to shares of the timeline; the frames in it."""
    said = tab.page.locator("#tofscope-timeline .range")
    for before, after in ((0.0, start), (0.998, end)):
        drag(tab, before, after, RANGE)
        tab.page.mouse.up()
        tab.until(lambda: said.inner_text().startswith("plays frames"))
        tab.page.wait_for_timeout(1000)  # what the session knows of it has come back
    first, last = (int(word) for word in said.inner_text().split() if word.isdigit())
    return range(first, last + 1)


def pictures_in(video: Path) -> NDArray[np.uint8]:
    """All pictures (N, height, width, 3) of a video."""
    command = [find_ffmpeg(), "-loglevel", "error", "-i", str(video)]
    command += ["-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    raw = subprocess.run(command, capture_output=True, check=True).stdout
    return np.frombuffer(raw, np.uint8).reshape(-1, _SIZE[1], _SIZE[0], 3)


def test_plots_are_saved_as_a_picture_and_as_a_drawing_for_print(wide_tab: Tab):
    tab = wide_tab
    tab.until(lambda: tab.has_text("pairs count"))
    download = saved(tab, "Save as", "PNG")
    assert download.suggested_filename == "robot_moving_0.25_1_plots.png"
    with Image.open(download.path()) as picture:
        assert picture.format == "PNG"
        size, dpi = np.array(picture.size), float(picture.info["dpi"][0])
        pixels = np.asarray(picture.convert("RGB")).astype(int)
    assert dpi == pytest.approx(300, abs=1)
    flow = ViewSettings().palette.flow
    assert (np.abs(pixels - flow) <= 12).all(axis=2).sum() > 200, "there are no points"
    assert (pixels < 60).all(axis=2).sum() > 1000, "there is no text"

    download = saved(tab, "Save as", "PDF")
    assert download.suggested_filename == "robot_moving_0.25_1_plots.pdf"
    pdf = download.path().read_bytes()
    assert pdf.startswith(b"%PDF")
    assert b"/FontFile2" in pdf, "text is not text"
    np.testing.assert_allclose(page_of(pdf), size / dpi * _INCH, rtol=0.02)
    assert 350 < page_of(pdf)[0] < 400  # as wide as a page of a paper without its margins


def test_the_drawing_is_saved_as_pdf_and_svg_of_the_chosen_size_on_paper(tab: Tab):
    tab.show("Export")
    tab.choose_option("Size", "88 x 62 mm")
    pdf = saved(tab, "Vector", "PDF").path().read_bytes()
    assert pdf.startswith(b"%PDF")
    wanted = [side / 25.4 * _INCH for side in (88, 62)]
    np.testing.assert_allclose(page_of(pdf), wanted, atol=0.1)
    download = saved(tab, "Vector", "SVG")
    assert download.suggested_filename == "robot_moving_0.25_1_frame_0024.svg"
    svg = ET.fromstring(download.path().read_text())
    sides = [float((svg.get(name) or "").removesuffix("pt")) for name in ("width", "height")]
    np.testing.assert_allclose(sides, wanted, atol=0.1)
    words = {element.text for element in svg.iter("{http://www.w3.org/2000/svg}text")}
    for said in tab.page.locator("[data-legend]").inner_text().splitlines():
        assert any(said.strip() in (word or "") for word in words), said
    assert any("robot_moving_0.25_1" in (word or "") for word in words)


def test_the_flow_of_a_frame_and_of_a_range_is_saved_as_numbers(tab: Tab):
    points, moving = fact(tab, "Source"), fact(tab, "Moving")
    assert points > moving > 20
    tab.show("Export")
    download = saved(tab, "Flow data", "CSV")
    assert download.suggested_filename == "robot_moving_0.25_1_frame_0024_flow.csv"
    rows = rows_of(download.path())
    assert len(rows) == points
    assert sum(row["vx"] != "" for row in rows) == moving
    written = np.array([[float(row[axis]) for axis in "xyz"] for row in rows if row["vx"]])
    assert from_each(written, tab.points("source")).max() < 1e-4

    with np.load(saved(tab, "Flow data", "NPZ").path()) as arrays:
        assert len(arrays["x"]) == points
        assert np.count_nonzero(arrays["label"] == Label.MOVING) == moving
        assert np.count_nonzero(np.isfinite(arrays["vx"])) == moving
        assert arrays["frames"].tolist() == [24]

    frames = play_only(tab, 0.5, 0.6)
    assert 2 < len(frames) < 7
    download = saved(tab, "Flow of range", "CSV")
    rows = rows_of(download.path())
    assert sorted({int(row["frame"]) for row in rows}) == list(frames)
    tab.until(lambda: tab.has_text(f"{download.suggested_filename}, {len(rows)} points"))


def test_a_video_of_the_range_is_saved_or_the_page_says_what_is_missing(
    tab: Tab, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
):
    frames = play_only(tab, 0.5, 0.53)
    tab.show("Export")
    tab.choose_option("Size", "Own size, pixels")
    for label, pixels in zip(("Own width", "Own height"), _SIZE, strict=True):
        field = tab.row(label).locator("input:not([type=hidden])")
        field.fill(str(pixels))
        field.press("Enter")
    tab.page.wait_for_timeout(300)  # until the session knows
    download = saved(tab, "Video", "MP4")
    name = f"robot_moving_0.25_1_frames_{frames[0]:04d}_{frames[-1]:04d}.mp4"
    assert download.suggested_filename == name
    assert download.path().read_bytes()[4:8] == b"ftyp"
    pictures = pictures_in(download.path())
    # At 30 pictures per second, two of each frame of 15.
    assert abs(len(pictures) - 2 * len(frames)) <= 1
    assert not np.array_equal(pictures[0], pictures[-1])
    green = pictures.astype(int)[..., 1] - pictures.astype(int)[..., [0, 2]].max(axis=-1)
    assert (green > 40).sum(axis=(1, 2)).min() > 10, "there is no flow"

    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    group(tab, "Video").get_by_role("button", name="MP4", exact=True).click()
    told = tab.page.get_by_role("alert").filter(has_text="MP4 files are written by ffmpeg")
    tab.until(lambda: told.count() == 1)
    assert "sudo apt-get install ffmpeg" in told.inner_text()
