"""The page in windows of all sizes: what must be in sight is, and nothing covers anything."""

from itertools import combinations

import pytest
from playwright.sync_api import FloatRect, Locator

from tests.browser.tab import SIZE, Tab

_ON_TOP = """element => {
  const box = element.getBoundingClientRect();
  const x = box.x + box.width / 2, y = box.y + box.height / 2;
  const found = document.elementFromPoint(x, y);
  return found !== null && (element === found || element.contains(found));
}"""
_ALWAYS = ("n", "γ", "δ", "N_min")
_OVER_THE_SCENE = ("[data-legend]", "#tofscope-corner", "#tofscope-timeline")
_PHONE = 390  # pixels
_WINDOWS = ((1280, 720), (1600, 900), (1920, 1080), (900, 700), (_PHONE, 844))


def in_sight(element: Locator) -> bool:
    """Whether the middle of an element is in the window, and on top."""
    return element.evaluate(_ON_TOP)


def apart(one: FloatRect, other: FloatRect) -> bool:
    return (
        one["x"] + one["width"] <= other["x"] + 1
        or other["x"] + other["width"] <= one["x"] + 1
        or one["y"] + one["height"] <= other["y"] + 1
        or other["y"] + other["height"] <= one["y"] + 1
    )


def boxes(tab: Tab) -> dict[str, FloatRect]:
    """Boxes in pixels of what lies over the scene and is shown."""
    found = {name: tab.page.locator(name) for name in _OVER_THE_SCENE}
    shown = {name: each.bounding_box() for name, each in found.items() if each.is_visible()}
    return {name: box for name, box in shown.items() if box is not None}


@pytest.fixture
def sized(tab: Tab):
    yield tab
    tab.page.set_viewport_size(SIZE)


def test_parameters_are_in_sight_and_nothing_overlaps(sized: Tab):
    for width, height in _WINDOWS:
        sized.page.set_viewport_size({"width": width, "height": height})
        for opened in ("Explain", "Compare", "View", "Export"):
            if width > _PHONE:  # where the tabs are folded away
                sized.show(opened)
            for label in _ALWAYS:
                thumb = sized.row(label).locator(".mantine-Slider-root")
                sized.until(lambda thumb=thumb: in_sight(thumb))
            sized.until(lambda: in_sight(sized.row("method").locator("input").first))
        laid = boxes(sized)
        assert "#tofscope-timeline" in laid
        for name, box in laid.items():
            assert box["x"] >= 0, (name, width)
            assert box["x"] + box["width"] <= width + 1, (name, width)
            assert box["y"] + box["height"] <= height + 1, (name, width)
        for one, other in combinations(laid, 2):
            assert apart(laid[one], laid[other]), (one, other, width)
        timeline, scene = laid["#tofscope-timeline"], sized.page.locator("canvas[data-engine]")
        assert timeline["y"] + timeline["height"] > height - 20, "along the bottom of the window"
        drawn = scene.bounding_box()
        assert drawn is not None
        assert timeline["width"] > 0.9 * min(drawn["width"], width)


_HEIGHTS = """() => {
  const leaf = document.querySelector("[data-testid=floating-panel]");
  const [above, , below] = leaf.closest("[data-dock-scroll]").children;
  const content = leaf.querySelector(".mantine-ScrollArea-content");
  const view = content.parentElement, foot = below.parentElement.getBoundingClientRect().bottom;
  return [view.offsetHeight - content.offsetHeight, foot - below.getBoundingClientRect().bottom,
    above.offsetHeight];
}"""
"""Pixels free below the parameters, and below the tabs; height of the parameters' panel."""


def test_the_tabs_have_the_height_that_the_parameters_leave_until_a_person_decides(sized: Tab):
    for width, height in ((1600, 900), (1920, 1080)):
        sized.page.set_viewport_size({"width": width, "height": height})
        sized.until(lambda: all(abs(free) < 20 for free in sized.page.evaluate(_HEIGHTS)[:2]))
    divider = sized.page.locator("[data-dock-divider=column]").bounding_box()
    assert divider is not None
    x, y = divider["x"] + divider["width"] / 2, divider["y"] + divider["height"] / 2
    for way in (-70, 200):
        before = sized.page.evaluate(_HEIGHTS)[2]
        sized.page.mouse.move(x, y)
        sized.page.mouse.down()
        sized.page.mouse.move(x, y + way / 2)
        sized.page.mouse.move(x, y + way)
        sized.page.wait_for_timeout(100)  # until it is drawn there
        sized.page.mouse.up()
        y += way
        sized.page.wait_for_timeout(500)  # in which it could be taken back
        assert abs(sized.page.evaluate(_HEIGHTS)[2] - before - way) < 15
