import numpy as np
from numpy.typing import NDArray

from tests.browser.tab import Tab

_CAMERA = """() => {
  const { camera, canvas } = window.__viserMutable;
  const box = canvas.getBoundingClientRect();
  const numbers = matrix => Array.from(matrix.elements);
  return [numbers(camera.projectionMatrix), numbers(camera.matrixWorldInverse),
          [box.left, box.top, box.width, box.height]];
}"""


def pixel(tab: Tab, point: NDArray[np.float64]) -> tuple[float, float]:
    """Where a point (3,) of the fixed frame is on the page."""
    projection, view, (left, top, width, height) = tab.page.evaluate(_CAMERA)
    matrices = [np.reshape(values, (4, 4)).T for values in (projection, view)]
    fixed = tab.poses(["source"])[0]
    x, y, _, w = matrices[0] @ matrices[1] @ fixed @ np.append(point, 1.0)
    return left + (1 + x / w) / 2 * width, top + (1 - y / w) / 2 * height


def test_a_click_on_a_point_picks_its_cluster_and_one_beside_it_none(tab: Tab):
    moving = tab.arrows()[:, 0]
    tab.page.get_by_text("Explain", exact=True).click()
    tab.page.mouse.click(*pixel(tab, moving[len(moving) // 2]))
    tab.until(lambda: tab.has_text("Moving: fitness"))
    picked = {tuple(point) for point in tab.points("picked/points")}
    assert {tuple(point) for point in moving} <= picked
    tab.page.mouse.click(5, 5)
    tab.until(lambda: not tab.has_text("Moving: fitness"))


def test_turning_the_camera_picks_nothing(tab: Tab):
    tab.page.get_by_text("Explain", exact=True).click()
    x, y = pixel(tab, tab.arrows()[0, 0])
    tab.page.mouse.move(x, y)
    tab.page.mouse.down()
    tab.page.mouse.move(x + 60, y + 20, steps=5)
    tab.page.mouse.up()
    tab.page.wait_for_timeout(700)
    assert tab.row("Cluster").locator("input").first.input_value() == "none"
