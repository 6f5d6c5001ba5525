"""What the page shows of recordings whose numbers are known: tracks, which way is up, zones."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from playwright.sync_api import BrowserContext

from app.analysis.estimates import Estimates
from app.analysis.library import Library
from app.analysis.notes import all_notes
from app.panels.sensor_images import STATES
from app.scene.colours import Colour
from app.scene.palettes import PAPER, palette
from app.server.server import Server
from app.server.session import Shared
from app.session.reload import Reloads
from estimator import Parameters
from recordings import open_recording
from tests.browser import made_recordings as made
from tests.browser.tab import Tab
from tests.browser.test_explain import pixel, pixels

_WRITERS = {
    "events_1": made.write_events,
    "grids_1": made.write_grids,
    "optical_1": made.write_optical,
    "warned_1": made.write_warned,
}
_LOOK = palette(PAPER, dark=False)
_COLUMN = """([canvas, x]) => {
  const ratio = window.devicePixelRatio, pen = canvas.getContext("2d");
  return Array.from(pen.getImageData(Math.floor(x * ratio), 0, 1, canvas.height).data);
}"""
_ZONE = """(canvas, [x, y]) => Array.from(canvas.getContext("2d").getImageData(
  Math.floor(x * canvas.width), Math.floor(y * canvas.height), 1, 1).data)"""
_SHOWN = "name => window.__viserSceneTree.getState()[name].effectiveVisibility !== false"
_MOTION, _ZONES, _STRIP = 22, 33, slice(40, 64)
"""Rows of the tracks' pixels: in the middle of those of motion and of valid zones, and the strip
of the chosen quantity."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("made")
    for name, write in _WRITERS.items():
        write(folder / f"{name}.mcap")
    return folder


@pytest.fixture(scope="module")
def made_tab(
    window: BrowserContext, recordings_folder: Path, folder: Path, estimates: Estimates
) -> Iterator[Tab]:
    """A page of a sample, at which it begins, and of the recordings that are made here."""
    [sample] = recordings_folder.glob("sideways*")
    shared = Shared(Library([sample, folder], open_recording), estimates, Reloads(), Parameters())
    server = Server(shared, "127.0.0.1", 0)
    tab = Tab(window, server.address)
    yield tab
    tab.page.close()
    server.close()


@pytest.fixture
def tab(made_tab: Tab) -> Iterator[Tab]:
    with made_tab.widened() as wide:
        yield wide


def column(tab: Tab, frame: float) -> NDArray[np.int64]:
    """Pixels (H, 4) of the timeline's tracks at a frame, or between two, from top to bottom."""
    canvas = tab.slider("Frame").locator("canvas")
    seconds = made.stamps_of_events() * 1e-9
    share = np.interp(frame, np.arange(made.FRAMES), seconds) / seconds[-1]
    x = share * canvas.evaluate("canvas => canvas.clientWidth")
    values = tab.page.evaluate(_COLUMN, [canvas.element_handle(), x])
    pixels = np.reshape(values, (-1, 4))
    return pixels[:: max(1, round(tab.page.evaluate("window.devicePixelRatio")))]


def has(pixel: NDArray[np.int64], colour: Colour) -> bool:
    """Whether a pixel has a colour, and nothing of what is below it."""
    return np.abs(pixel - [*colour, 255]).max() <= 3


def height(tab: Tab, frame: int) -> float:
    """Pixels from the strip's foot to the middle of the dot at a frame, NaN without one."""
    rows = [row for row, pixel in enumerate(column(tab, frame)[_STRIP]) if has(pixel, _LOOK.flow)]
    return _STRIP.stop - _STRIP.start - float(np.mean(rows)) if rows else np.nan


def test_the_tracks_show_motion_gaps_empty_frames_valid_zones_and_a_quantity(tab: Tab):
    tab.open("events")
    tab.set_slider("Frame", "Home")
    tab.until(lambda: tab.is_at(0))
    tab.page.get_by_label("Plotted quantity").select_option("points")
    tab.until(lambda: np.isfinite(height(tab, 27)))

    def drawn(frame: float, row: int) -> NDArray[np.int64]:
        return column(tab, frame)[row]

    for frame, colour in (
        (sum(made.MOVING) / 2, _LOOK.flow),
        (sum(made.EMPTY) / 2, _LOOK.unassigned),
        (made.GAP - 0.5, _LOOK.category(4)),
    ):
        tab.until(lambda at=frame, of=colour: has(drawn(at, _MOTION), of))
        for none in (1.5, 12.5, 18.5, 25.0):
            assert not has(drawn(none, _MOTION), colour), (frame, none)

    # Darker where more zones are valid.
    whole, half, none = (drawn(k, _ZONES)[3] for k in (12.5, 25.5, made.EMPTY[1] - 0.5))
    assert whole > 1.5 * half
    assert half > 1.5 * none

    # Points of the source, which is n = 8 frames before.
    assert np.isnan(height(tab, 4))
    all_points, half_of_them = height(tab, 12), height(tab, 28)
    assert all_points > 15
    assert abs(half_of_them - all_points / 2) <= 2
    assert height(tab, sum(made.EMPTY) // 2 + 8) < 4

    loop = tab.page.get_by_role("button", name="Loop", exact=True)
    assert loop.get_attribute("aria-pressed") == "false"  # it lasts for more than ten seconds


def test_in_an_optical_frame_nothing_is_upside_down_and_the_grid_stands_aside(tab: Tab):
    tab.until(lambda: tab.page.evaluate(_SHOWN, "/grid"))
    tab.open("optical")
    tab.until(lambda: not tab.page.evaluate(_SHOWN, "/grid"))
    points = np.vstack([tab.points(cloud) for cloud in ("target", "static_target")])
    assert len(points) == made.ZONES
    # y of an optical frame points down; the page's own points up.
    np.testing.assert_allclose(tab.poses(["source"])[0][:3, 1], [0.0, -1.0, 0.0], atol=1e-6)
    high, low = (
        points[np.lexsort((points[:, 0], sign * points[:, 1]))][:8] for sign in (1.0, -1.0)
    )
    for key in ("1", "3", "4", "5"):
        tab.page.keyboard.press(key)
        pixel(tab, points[0])  # once the camera stands still
        assert (pixels(tab, high)[:, 1] < pixels(tab, low)[:, 1] - 5).all(), key
    tab.show("View")
    for _ in range(2):
        tab.row("Grid and axes").locator("input").click()
        tab.page.wait_for_timeout(300)
        assert not tab.page.evaluate(_SHOWN, "/grid")
    tab.open("sideways")
    tab.until(lambda: tab.page.evaluate(_SHOWN, "/grid"))


def colour_of(millimetres: float, limit: float) -> NDArray[np.uint8]:
    """Colour of a distance in an image whose scale ends at a limit in metres."""
    value = int(np.sqrt(millimetres / 1000 / limit) * STATES)
    return _LOOK.along_ramp(np.linspace(1.0, 0.0, STATES))[value]


def test_images_have_the_grids_of_their_sensors_and_each_zone_its_distance(tab: Tab):
    tab.open("grids")
    tab.page.get_by_role("tab", name="Sensors").or_(
        tab.page.get_by_text("Sensors", exact=True)
    ).first.click()
    tab.until(lambda: tab.page.locator(".tofscope-sensor").count() == len(made.GRIDS))
    ramp = tab.page.locator(".tofscope-sensors-ramp")
    tab.until(ramp.is_visible)
    limit = float(ramp.inner_text().split()[-2])
    tip = tab.page.locator(".tofscope-tip")
    for name, (rows, columns) in made.GRIDS.items():
        read = made.distances(rows, columns)
        tile = tab.page.locator(".tofscope-sensor").filter(
            has=tab.page.locator(f".tofscope-sensor-name[title='{name}']")
        )
        canvas = tile.locator("canvas")
        box = canvas.bounding_box()
        assert box is not None
        assert box["width"] / box["height"] == pytest.approx(columns / rows, rel=0.05), name
        for row, across in ((0, 0), (rows - 1, 0), (1, columns - 1), (rows - 1, columns - 1)):
            place = np.array([(across + 0.5) / columns, (row + 0.5) / rows])
            said = canvas.evaluate(_ZONE, place.tolist())
            wanted = colour_of(read[row, across], limit)
            assert np.abs(np.array(said[:3]) - wanted).max() <= 6, (name, row, across)
            tab.page.mouse.move(*(place * [box["width"], box["height"]] + [box["x"], box["y"]]))
            head = f"{name}, row {row}, column {across}"
            tab.until(lambda head=head: tip.is_visible() and head in tip.inner_text())
            assert f"{read[row, across] / 1000:.3f} m" in tip.inner_text()


def test_what_is_to_be_known_of_a_recording_is_shown(tab: Tab, folder: Path):
    tab.open("warned")
    with open_recording(folder / "warned_1.mcap") as recording:
        notes = all_notes(recording)
    assert len(notes) == 4
    tab.page.get_by_role("button", name="4 notes").click()
    card = tab.page.get_by_role("dialog", name="Notes on warned_1")
    tab.until(card.is_visible)
    assert card.locator("li").all_inner_texts() == notes
    card.get_by_role("button", name="Close").click()
    tab.until(lambda: not card.is_visible())
