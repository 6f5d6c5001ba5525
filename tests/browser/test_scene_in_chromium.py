import json

import numpy as np
from PIL import Image
from playwright.sync_api import FloatRect

from app.scene.palettes import COLOUR_BLIND, PAPER, palette
from app.scene.scene_root import FIXED
from tests.browser.tab import Tab

_CAMERA = """() => {
  const camera = window.__viserMutable.camera;
  camera.updateMatrixWorld();
  return {near: camera.near, forward: Array.from(camera.matrixWorld.elements.slice(8, 11))};
}"""
_PROPS = "name => window.__viserSceneTree.getState()[name].message.props"


_SCALE = """() => {
  const {cameraControl, camera} = window.__viserMutable;
  const height = document.querySelector("canvas[data-engine]").clientHeight;
  return height / (2 * cameraControl.distance * Math.tan(camera.fov * Math.PI / 360));
}"""


def props(tab: Tab, node: str):
    return tab.page.evaluate(_PROPS, f"{FIXED}/{node}")


def colours(tab: Tab, node: str) -> list[list[int]]:
    values = props(tab, node)["colors"]
    flat = list(values.values()) if isinstance(values, dict) else values
    return np.unique(np.reshape(flat, (-1, 3)), axis=0).tolist()


def downwards(tab: Tab) -> float:
    """Downward tilt of the camera: 1 straight down, 0 level; y is up in the page's own frame."""
    return tab.page.evaluate(_CAMERA)["forward"][1]


def test_views_have_buttons_and_keys(tab: Tab):
    tab.show("View")
    tab.page.get_by_role("button", name="Above", exact=True).click()
    tab.until(lambda: downwards(tab) > 0.99)
    tab.page.locator("canvas[data-engine]").click()
    tab.page.keyboard.press("3")
    tab.until(lambda: abs(downwards(tab)) < 0.01)
    tab.page.keyboard.press("1")
    tab.until(lambda: 0.2 < downwards(tab) < 0.9)


def test_points_are_as_large_in_a_near_view_as_in_a_far_one(tab: Tab):
    far, near_plane = props(tab, "source")["point_size"], tab.page.evaluate(_CAMERA)["near"]
    assert near_plane > 0.3
    tab.show("View")
    tab.page.get_by_role("button", name="Sensors", exact=True).click()
    tab.until(lambda: props(tab, "source")["point_size"] < 0.8 * far)
    tab.until(lambda: tab.page.evaluate(_CAMERA)["near"] < near_plane)


def test_colours_and_dark(tab: Tab):
    tab.show("View")
    assert colours(tab, "target") == [list(palette(PAPER, dark=False).target)]
    tab.row("Dark").locator("input").click()
    tab.until(lambda: colours(tab, "target") == [list(palette(PAPER, dark=True).target)])
    tab.until(lambda: tab.page.locator("html[data-mantine-color-scheme=dark]").count() == 1)
    tab.choose_option("Colours", COLOUR_BLIND)
    tab.until(lambda: colours(tab, "target") == [list(palette(COLOUR_BLIND, dark=True).target)])
    assert len(colours(tab, "flow")) == 1
    tab.choose_option("Arrows show", "Speed")
    tab.until(lambda: len(colours(tab, "flow")) > 3)
    tab.until(lambda: tab.page.locator("[data-legend]").filter(has_text="m/s").count() == 1)


def test_the_legend_lies_in_the_lower_left_corner(tab: Tab):
    legend = tab.page.locator("[data-legend]")
    assert legend.inner_text().split()[:4] == ["Source", "moving", "stationary", "unassigned"]
    box, scene = legend.bounding_box(), tab.page.locator("canvas[data-engine]").bounding_box()
    assert box is not None
    assert scene is not None
    assert 0 < box["x"] - scene["x"] < 30
    assert 0 < scene["y"] + scene["height"] - box["y"] - box["height"] < 100  # above the line


def test_why_nothing_moves_is_said_above_the_legend_with_a_way_to_motion(tab: Tab):
    note = tab.page.locator("#tofscope-note")
    assert note.is_hidden()
    tab.page.keyboard.press("Home")
    tab.until(lambda: "No pair" in note.inner_text())
    above, legend = note.bounding_box(), tab.page.locator("[data-legend]").bounding_box()
    assert above is not None
    assert legend is not None
    assert above["y"] + above["height"] <= legend["y"]
    note.get_by_role("button", name="To the next motion").click()
    tab.until(lambda: "No pair" not in note.inner_text() or note.is_hidden())


def test_the_two_views_of_papers_are_one_file_that_says_what_it_shows(tab: Tab):
    tab.show("Export")
    tab.row("Views").locator("input").first.click()
    tab.page.get_by_role("option", name="Slanted and from above").click()
    tab.row("Size").locator("input").first.click()
    tab.page.get_by_role("option", name="1280 x 720").click()
    tab.page.wait_for_timeout(200)
    size = props(tab, "source")["point_size"]
    with tab.page.expect_download() as download:
        tab.page.get_by_role("button", name="Save screenshot").click()
    assert download.value.suggested_filename.endswith("_slanted_from_above.png")
    with Image.open(download.value.path()) as picture:
        assert picture.size == (2560, 720)
        assert json.loads(picture.info["Parameters"])["gamma"] == 0.7
        assert picture.info["Data"].startswith("simulated")
    tab.until(lambda: np.isclose(props(tab, "source")["point_size"], size))


def forward(tab: Tab) -> list[float]:
    return tab.page.evaluate(_CAMERA)["forward"]


def box(tab: Tab, selector: str) -> FloatRect:
    found = tab.page.locator(selector).bounding_box()
    assert found is not None
    return found


def length_error(tab: Tab) -> float:
    """Relative error of the scale bar."""
    number, unit = tab.page.locator("#tofscope-corner .length").inner_text().split()
    metres = float(number) * {"m": 1.0, "cm": 0.01, "mm": 0.001}[unit]
    return abs(
        box(tab, "#tofscope-corner .bar")["width"] / (metres * tab.page.evaluate(_SCALE)) - 1
    )


def test_the_corner_says_what_is_drawn_and_how_large(tab: Tab):
    corner = tab.page.locator("#tofscope-corner")
    tab.until(lambda: "frame 24 of 38 · 1.60 s · Δt 0.533 s" in corner.inner_text())
    assert "robot_moving_0.25_1 (simulated)" in corner.inner_text()
    assert "n 8, γ 0.7, δ 0.04 m, N_min 60" in corner.inner_text()
    whole = corner.inner_text()
    tab.page.keyboard.press("Home")  # without a pair, hence without its interval
    tab.until(lambda: "frame 0 of 38" in corner.inner_text())
    assert "robot_moving_0.25_1 (simulated)" in corner.inner_text()
    tab.set_slider("Frame", "ArrowRight", 24)
    tab.until(lambda: corner.inner_text() == whole)
    legend, line = box(tab, "[data-legend]"), box(tab, "#tofscope-corner")
    scene = box(tab, "canvas[data-engine]")
    assert legend["y"] + legend["height"] <= line["y"]
    assert scene["x"] < line["x"]
    assert line["x"] + line["width"] < scene["x"] + scene["width"]
    assert line["y"] + line["height"] < scene["y"] + scene["height"]
    tab.until(lambda: length_error(tab) < 0.02)
    before = tab.page.evaluate(_SCALE)
    tab.page.mouse.move(scene["x"] + scene["width"] / 2, scene["y"] + scene["height"] / 2)
    for _ in range(4):
        tab.page.mouse.wheel(0, 200)
    tab.until(lambda: tab.page.evaluate(_SCALE) < 0.8 * before)
    tab.until(lambda: length_error(tab) < 0.02)
    assert box(tab, "#tofscope-corner .bar")["width"] < 0.26 * scene["width"]
    tab.show("View")
    tab.row("Legend").locator("input").click()
    tab.until(lambda: not corner.is_visible())


def test_a_recording_is_framed_anew_and_fit_keeps_a_sensible_direction(tab: Tab):
    begun = forward(tab)
    tab.show("View")
    tab.page.get_by_role("button", name="Sensors", exact=True).click()
    tab.until(lambda: not np.allclose(forward(tab), begun, atol=0.2))
    tab.page.get_by_role("button", name="Fit", exact=True).click()
    tab.until(lambda: np.allclose(forward(tab), begun, atol=0.05))
    tab.page.get_by_role("button", name="Above", exact=True).click()
    tab.until(lambda: downwards(tab) > 0.99)
    tab.open("sideways")
    tab.until(lambda: 0.2 < downwards(tab) < 0.9)
    assert props(tab, "true_object/0_target")["opacity"] < 1
