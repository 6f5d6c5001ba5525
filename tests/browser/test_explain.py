import numpy as np
from numpy.typing import NDArray

from tests.browser.tab import Tab
from tests.browser.test_sizes_in_chromium import in_sight

_CAMERA = """() => {
  const { camera, canvas } = window.__viserMutable;
  const box = canvas.getBoundingClientRect();
  const numbers = matrix => Array.from(matrix.elements);
  return [numbers(camera.projectionMatrix), numbers(camera.matrixWorldInverse),
          [box.left, box.top, box.width, box.height]];
}"""


def pixel(tab: Tab, point: NDArray[np.float64]) -> tuple[float, float]:
    """Page position in pixels of a point (3,) in the fixed frame, once the camera stands still."""
    before = np.full((1, 2), np.nan)

    def still() -> bool:
        nonlocal before
        tab.page.wait_for_timeout(300)
        last, before = before, pixels(tab, point[None])
        return bool(np.abs(before - last).max() < 0.5)

    tab.until(still)
    return tuple(before[0])


def pixels(tab: Tab, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Page positions (N, 2) in pixels of points (N, 3) in the fixed frame."""
    projection, view, (left, top, width, height) = tab.page.evaluate(_CAMERA)
    matrices = [np.reshape(values, (4, 4)).T for values in (projection, view)]
    fixed = tab.poses(["source"])[0]
    ones = np.ones((len(points), 1))
    x, y, _, w = matrices[0] @ matrices[1] @ fixed @ np.hstack([points, ones]).T
    return np.stack([left + (1 + x / w) / 2 * width, top + (1 - y / w) / 2 * height], axis=1)


def background(tab: Tab) -> tuple[float, float]:
    """A pixel of the scene as far from every point as there is one."""
    clouds = ("source", "target", "static_source", "static_target")
    points = np.vstack([tab.points(cloud) for cloud in clouds])
    taken = pixels(tab, points)
    free = [(x, y) for x in range(80, 500, 10) for y in range(220, 440, 10)]
    return max(free, key=lambda place: np.linalg.norm(taken - place, axis=1).min())


def point_set(points: NDArray[np.float64]) -> set[tuple[float, ...]]:
    return {tuple(point) for point in points.tolist()}


def told(tab: Tab) -> int:
    """In how many places a person sees the story of the moving cluster."""
    return tab.page.get_by_text("Moving: fitness").filter(visible=True).count()


def test_a_click_on_a_point_tells_the_story_of_its_cluster_and_one_beside_it_lets_it_go(tab: Tab):
    tab.show("Compare")
    moving, card = tab.points("source"), tab.page.locator(".tofscope-pinned")
    place = pixel(tab, moving[len(moving) // 2])
    tab.page.mouse.click(*place)
    said = card.get_by_text("Moving: fitness")
    tab.until(said.is_visible)
    tab.until(lambda: point_set(moving) <= point_set(tab.points("picked/points")))
    # None is drawn twice.
    tab.until(lambda: not point_set(tab.points("picked/points")) & point_set(tab.points("source")))

    # The tabs stay as they are, and Explain knows it, too.
    compare = tab.page.get_by_role("tab", name="Compare", exact=True)
    assert compare.get_attribute("aria-selected") == "true"
    assert told(tab) == 1
    tab.show("Explain")
    tab.until(lambda: told(tab) == 2)
    tab.page.mouse.click(*place)
    tab.page.wait_for_timeout(1000)
    assert told(tab) == 2
    tab.begin_again()
    tab.until(lambda: told(tab) == 0 and not card.is_visible())

    tab.page.mouse.click(*pixel(tab, moving[len(moving) // 2]))
    tab.until(said.is_visible)
    tab.page.mouse.click(*background(tab))
    tab.until(lambda: not tab.has_text("Moving: fitness"))
    assert not card.is_visible()


def test_a_click_on_a_row_of_the_table_picks_its_cluster_and_another_lets_it_go(tab: Tab):
    row = tab.page.locator("tr[data-sets]", has_text="moving")
    moving = point_set(tab.points("source"))
    row.click()
    tab.until(lambda: tab.has_text("Moving: fitness"))
    tab.until(lambda: moving <= point_set(tab.points("picked/points")))
    row.click()
    tab.until(lambda: not tab.has_text("Moving: fitness"))
    cluster = tab.row("Cluster").locator("input").first
    tab.until(lambda: cluster.input_value() == "none")


def test_turning_the_camera_picks_nothing(tab: Tab):
    x, y = pixel(tab, tab.points("source")[0])
    tab.page.mouse.move(x, y)
    tab.page.mouse.down()
    tab.page.mouse.move(x + 60, y + 20, steps=5)
    tab.page.mouse.up()
    tab.page.wait_for_timeout(700)
    assert tab.row("Cluster").locator("input").first.input_value() == "none"


def test_after_a_click_on_a_row_its_story_is_in_sight(tab: Tab):
    story = tab.page.locator("#tofscope-story")
    rows = tab.page.locator("tr[data-sets]")
    for row in (rows.first, rows.last):
        row.click()
        number = row.locator("td").first.inner_text()
        title = story.get_by_text(f"Cluster {number}", exact=True)
        tab.until(lambda title=title: title.count() == 1 and in_sight(title))
    outcome = story.locator("svg").last  # beside the sentence at its end
    assert in_sight(outcome), "a story that is as short as this one is not whole"
