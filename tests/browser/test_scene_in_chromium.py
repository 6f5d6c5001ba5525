import json

import numpy as np
from PIL import Image

from app.scene.palettes import COLOUR_BLIND, PAPER, palette
from app.scene.scene_root import FIXED
from tests.browser.tab import Tab

_CAMERA = """() => {
  const camera = window.__viserMutable.camera;
  camera.updateMatrixWorld();
  return {near: camera.near, forward: Array.from(camera.matrixWorld.elements.slice(8, 11))};
}"""
_PROPS = "name => window.__viserSceneTree.getState()[name].message.props"


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
    tab.page.get_by_role("button", name="Top", exact=True).click()
    tab.until(lambda: downwards(tab) > 0.99)
    tab.page.locator("canvas[data-engine]").click()
    tab.page.keyboard.press("3")
    tab.until(lambda: abs(downwards(tab)) < 0.01)
    tab.page.keyboard.press("1")
    tab.until(lambda: 0.2 < downwards(tab) < 0.9)


def test_points_are_as_large_in_a_near_view_as_in_a_far_one(tab: Tab):
    far, near_plane = props(tab, "source")["point_size"], tab.page.evaluate(_CAMERA)["near"]
    assert near_plane > 0.3
    tab.page.get_by_role("button", name="Robot", exact=True).click()
    tab.until(lambda: props(tab, "source")["point_size"] < 0.8 * far)
    tab.until(lambda: tab.page.evaluate(_CAMERA)["near"] < near_plane)


def test_colours_and_dark(tab: Tab):
    tab.page.get_by_text("Colours, sizes, layers").click()
    assert colours(tab, "target") == [list(palette(PAPER, dark=False).target)]
    tab.row("Dark").locator("input").click()
    tab.until(lambda: colours(tab, "target") == [list(palette(PAPER, dark=True).target)])
    tab.until(lambda: tab.page.locator("html[data-mantine-color-scheme=dark]").count() == 1)
    tab.row("Colours").locator("input").first.click()
    tab.page.get_by_role("option", name=COLOUR_BLIND).click()
    tab.until(lambda: colours(tab, "target") == [list(palette(COLOUR_BLIND, dark=True).target)])
    assert len(colours(tab, "flow")) == 1
    tab.row("Arrows show").locator("input").first.click()
    tab.page.get_by_role("option", name="Speed").click()
    tab.until(lambda: len(colours(tab, "flow")) > 3)
    tab.until(lambda: tab.page.locator("[data-legend]").filter(has_text="m/s").count() == 1)


def test_the_legend_lies_in_the_lower_left_corner(tab: Tab):
    legend = tab.page.locator("[data-legend]")
    assert "Source: stationary" in legend.inner_text()
    box, scene = legend.bounding_box(), tab.page.locator("canvas[data-engine]").bounding_box()
    assert box is not None
    assert scene is not None
    assert 0 < box["x"] - scene["x"] < 30
    assert 0 < scene["y"] + scene["height"] - box["y"] - box["height"] < 30


def test_the_two_views_of_papers_are_one_file_that_says_what_it_shows(tab: Tab):
    tab.page.get_by_text("Screenshot options", exact=True).click()
    tab.row("Size").locator("input").first.click()
    tab.page.get_by_role("option", name="1280 x 720").click()
    tab.page.wait_for_timeout(200)
    size = props(tab, "source")["point_size"]
    with tab.page.expect_download() as download:
        tab.page.get_by_role("button", name="Save 3D and top view").click()
    assert download.value.suggested_filename.endswith("_3d_top.png")
    with Image.open(download.value.path()) as picture:
        assert picture.size == (2560, 720)
        assert json.loads(picture.info["Parameters"])["gamma"] == 0.7
        assert picture.info["Data"].startswith("simulated")
    tab.until(lambda: np.isclose(props(tab, "source")["point_size"], size))
