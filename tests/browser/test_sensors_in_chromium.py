"""Sensors as images, and points that answer."""

import numpy as np
import pytest
from playwright.sync_api import Locator

from app.scene.scene_root import FIXED
from tests.browser.tab import Tab
from tests.browser.test_explain import pixel, pixels, point_set

_CAMERA = """() => {
  const camera = window.__viserMutable.camera;
  camera.updateMatrixWorld();
  return Array.from(camera.matrixWorld.elements);
}"""
_PIXEL = """(canvas, [x, y]) => Array.from(canvas.getContext("2d").getImageData(
  x * canvas.width, y * canvas.height, 1, 1).data)"""
_IN_SCENE = """places => places.filter(
  ([x, y]) => document.elementFromPoint(x, y) === window.__viserMutable.canvas)"""
_VISIBLE = """name => {
  const node = window.__viserSceneTree.getState()[name];
  return Boolean(node?.effectiveVisibility);
}"""


@pytest.fixture
def tab(wide_tab: Tab) -> Tab:
    return wide_tab


@pytest.fixture
def sensors(tab: Tab) -> Tab:
    """The page with the sensors' images."""
    tab.until(lambda: tab.has_text("Simulated: robot_moving"))
    tab.page.get_by_role("tab", name="Sensors").or_(
        tab.page.get_by_text("Sensors", exact=True)
    ).first.click()
    tab.until(lambda: tab.page.locator(".tofscope-sensor").count() == 24)
    tab.until(lambda: tab.page.locator(".tofscope-sensors-ramp").is_visible())
    return tab


def image(tab: Tab, name: str) -> Locator:
    """The image of the sensor with this name."""
    tiles = tab.page.locator(".tofscope-sensor")
    return tiles.filter(has=tab.page.locator(f".tofscope-sensor-name[title='{name}']"))


def zone(tab: Tab, name: str, row: int, column: int) -> tuple[float, float]:
    """Pixel in the middle of a zone of an image."""
    box = image(tab, name).locator("canvas").bounding_box()
    assert box is not None
    return (
        box["x"] + (column + 0.5) * box["width"] / 8,
        box["y"] + (row + 0.5) * box["height"] / 8,
    )


def tip(tab: Tab) -> str:
    found = tab.page.locator(".tofscope-tip")
    return found.inner_text() if found.is_visible() else ""


def card(tab: Tab) -> str:
    found = tab.page.locator(".tofscope-pinned")
    return found.inner_text() if found.is_visible() else ""


def position(text: str) -> np.ndarray:
    """Coordinates in an answer."""
    line = text.split("Position")[1].strip().split(" m")[0]
    return np.array([float(part) for part in line.replace("−", "-").split(",")])


def selected(tab: Tab) -> list[str]:
    names = tab.page.locator(".tofscope-sensor.selected .tofscope-sensor-name")
    return names.evaluate_all("all => all.map(name => name.title)")


def drawn_points(tab: Tab) -> np.ndarray:
    clouds = ("source", "target", "static_source", "static_target")
    return np.vstack([tab.points(cloud) for cloud in clouds])


def void(tab: Tab) -> tuple[float, float]:
    """A pixel of the scene above everything that is drawn."""
    places = [(x, y) for x in range(330, 900, 15) for y in range(20, 600, 15)]
    places = tab.page.evaluate(_IN_SCENE, places)
    names = [f"sensors/{name}" for name in tab.frustums()]
    centres = (np.linalg.inv(tab.poses(["source"])[0]) @ tab.poses(names))[:, :3, 3]
    taken = pixels(tab, np.vstack([drawn_points(tab), centres]))
    return max(places, key=lambda place: np.linalg.norm(taken - place, axis=1).min())


def test_the_page_says_which_sensors_see_what_moves_and_selects_one_by_its_name(sensors: Tab):
    said = sensors.page.locator(".tofscope-sensors-moving")
    assert said.inner_text().startswith("Something moves in front of base/2 (")
    assert "moves" in (image(sensors, "base/2").get_attribute("class") or "")
    assert image(sensors, "base/5").get_attribute("data-count") == ""
    said.locator("button").first.click()
    sensors.until(lambda: selected(sensors) == ["base/2"])
    sensors.until(lambda: sensors.has_text("base/2, read at the frame's stamp"))
    sensors.until(lambda: sensors.page.evaluate(_VISIBLE, f"{FIXED}/selected_sensor"))
    sensors.page.keyboard.press("Escape")
    sensors.until(lambda: selected(sensors) == [])
    sensors.until(lambda: not sensors.page.evaluate(_VISIBLE, f"{FIXED}/selected_sensor"))


def test_a_zone_answers_and_marks_its_point_which_answers_the_same(sensors: Tab):
    sensors.page.mouse.move(*zone(sensors, "base/2", 3, 4))
    sensors.until(lambda: "base/2, row 3, column 4" in tip(sensors) and "moving" in tip(sensors))
    words = tip(sensors)
    assert "Distance" in words
    assert "True velocity" in words
    sensors.until(lambda: len(sensors.points("pointer/points")) == 1)
    marked = sensors.points("pointer/points")
    np.testing.assert_allclose(marked[0], position(words), atol=6e-4)
    ray = sensors.points("pointer/rays")
    np.testing.assert_allclose(ray[1], marked[0], atol=1e-6)
    sensors.page.mouse.click(*zone(sensors, "base/2", 3, 4))
    sensors.until(lambda: "base/2, row 3, column 4" in card(sensors))
    assert selected(sensors) == ["base/2"]
    sensors.page.mouse.move(*void(sensors))
    sensors.until(lambda: tip(sensors) == "")
    sensors.page.get_by_role("button", name="Let go").click()
    sensors.until(lambda: card(sensors) == "")


def test_a_point_of_the_scene_answers_and_a_click_pins_it_and_selects(sensors: Tab):
    moving = sensors.points("source")
    taken = pixels(sensors, np.vstack([moving, sensors.points("target")]))
    apart = [np.sort(np.linalg.norm(taken - place, axis=1))[1] for place in taken[: len(moving)]]
    point = moving[int(np.argmax(apart))]
    place = pixel(sensors, point)
    sensors.page.mouse.move(place[0] - 3, place[1])
    sensors.page.mouse.move(*place)
    sensors.until(lambda: "(source)" in tip(sensors))
    np.testing.assert_allclose(position(tip(sensors)), point, atol=6e-4)
    for word in ("moving", "Velocity", "True velocity", "Error", "Cluster"):
        assert word in tip(sensors)
    name = tip(sensors).split(",")[0]
    sensors.page.mouse.click(*place)
    sensors.until(lambda: card(sensors).startswith(name))
    sensors.until(lambda: selected(sensors) == [name])
    sensors.until(lambda: point_set(moving) <= point_set(sensors.points("picked/points")))
    sensors.page.mouse.click(*void(sensors))
    sensors.until(lambda: card(sensors) == "" and selected(sensors) == [])


def test_a_click_on_a_frustum_selects_its_sensor_and_the_camera_goes_there(sensors: Tab):
    names = [sensors.node("sensors", name) for name in ("base_2", "elbow_0", "end_effector_6")]
    fixed = np.linalg.inv(sensors.poses(["source"])[0])
    inside = np.array([[0.0, 0.0, depth, 1.0] for depth in (0.03, 0.05, 0.07, 0.09)])
    points = np.vstack([(inside @ (fixed @ pose).T)[:, :3] for pose in sensors.poses(names)])
    pixel(sensors, points[0])  # once the camera stands still
    taken = pixels(sensors, drawn_points(sensors))
    places = pixels(sensors, points)
    free = [np.linalg.norm(taken - place, axis=1).min() for place in places]
    place = places[int(np.argmax(free))]  # away from points, which come first
    sensors.page.mouse.move(place[0] - 2, place[1])
    sensors.page.mouse.move(*place)
    sensors.until(lambda: tip(sensors).startswith("Sensor "))
    name = tip(sensors).removeprefix("Sensor ").strip()
    sensors.page.mouse.click(*place)
    sensors.until(lambda: selected(sensors) == [name])
    sensors.page.get_by_role("button", name="From this sensor").first.click()

    def there() -> bool:
        camera = np.reshape(sensors.page.evaluate(_CAMERA), (4, 4)).T
        pose = sensors.poses([sensors.node("sensors", name.replace("/", "_"))])[0]
        # three.js looks along its -z with y up, the sensor along z with y down.
        turned = camera[:3, :3] @ np.diag([1.0, -1.0, -1.0])
        return bool(
            np.linalg.norm(camera[:3, 3] - pose[:3, 3]) < 0.03
            and np.allclose(turned, pose[:3, :3], atol=0.02)
        )

    sensors.until(there)


def test_an_image_has_the_way_up_of_its_sensor_and_labels_have_the_scenes_colours(sensors: Tab):
    # What is on the left in an image is to the left of the sensor, and above is above.
    answers: dict[tuple[int, int], np.ndarray] = {}
    for row, column in ((0, 1), (0, 6), (7, 1)):
        sensors.page.mouse.move(*zone(sensors, "elbow/4", row, column))
        head = f"elbow/4, row {row}, column {column}"
        sensors.until(lambda head=head: head in tip(sensors))
        answers[row, column] = position(tip(sensors))
    pose = sensors.poses([sensors.node("sensors", "elbow_4")])[0]
    fixed = sensors.poses(["source"])[0]
    to_sensor = np.linalg.inv(pose) @ fixed
    left, right, below = (
        (to_sensor @ [*answers[place], 1.0])[:3] for place in ((0, 1), (0, 6), (7, 1))
    )
    assert left[0] < 0 < right[0]
    assert left[1] < 0 < below[1]
    sensors.row("Colour").locator("input").first.click()
    sensors.page.get_by_role("option", name="Label", exact=True).click()
    sensors.until(lambda: not sensors.page.locator(".tofscope-sensors-ramp").is_visible())
    middle = image(sensors, "base/2").locator("canvas")
    blue = (31, 99, 200)
    sensors.until(lambda: tuple(middle.evaluate(_PIXEL, [0.46, 0.46])[:3]) == blue)
