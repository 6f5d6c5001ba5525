"""What moves stands out in the scene: arrows, points, and the static scene behind them."""

import numpy as np
from numpy.typing import NDArray

from app.scene.scene_root import FIXED
from estimator import Label, Parameters, estimate, window_of_pair
from recordings import open_recording, sample_paths
from tests.browser.tab import Tab

_PROPS = "name => window.__viserSceneTree.getState()[name].message.props"


def moved_points(frame: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Moving source points (N, 3) of the sample, and where each went over the pair (N, 3)."""
    [path] = (path for path in sample_paths() if "robot_moving" in path.name)
    parameters = Parameters()
    with open_recording(path) as recording:
        interval = recording.stamps[frame] - recording.stamps[frame - parameters.n]
        source, target = recording.cloud(frame - parameters.n), recording.cloud(frame)
        flow = estimate(window_of_pair(source, target, interval), parameters)
    moving = flow.label == Label.MOVING
    start = source.points[moving]
    return start, start + interval * flow.velocity[moving]


def from_each(points: NDArray[np.float64], others: NDArray[np.float64]) -> NDArray[np.float64]:
    """Distance of each point to the nearest of the others, metres."""
    return np.linalg.norm(points[:, None] - others[None], axis=2).min(axis=1)


def test_an_arrow_leads_from_each_moving_point_to_where_it_went(tab: Tab):
    start, end = moved_points(tab.drawn_frame())
    drawn = tab.arrows()
    assert len(drawn) == len(start) > 20
    assert from_each(end, drawn[:, 1]).max() < 1e-3
    # The shaft begins beside its point, and so leaves it free, on the line to its end.
    nearest = np.linalg.norm(end[:, None] - drawn[None, :, 1], axis=2).argmin(axis=1)
    shaft, way = end - drawn[nearest, 0], end - start
    assert np.linalg.norm(np.cross(shaft, way), axis=1).max() < 1e-3
    radius = tab.page.evaluate(_PROPS, f"{FIXED}/source")["point_size"]
    shafts, ways = np.linalg.norm(shaft, axis=1), np.linalg.norm(way, axis=1)
    assert (shafts[ways > 3 * radius] < ways[ways > 3 * radius] - 0.9 * radius).all()
    assert "displacement" in tab.page.locator("[data-legend]").inner_text().lower()


def test_the_static_scene_is_dimmed_until_it_is_shown_or_hidden(tab: Tab):
    def size(node: str) -> float:
        return tab.page.evaluate(_PROPS, f"{FIXED}/{node}")["point_size"]

    def contrast(node: str) -> float:
        """Difference of a cloud's colours from white, which is behind it."""
        colours = tab.page.evaluate(_PROPS, f"{FIXED}/{node}")["colors"]
        flat = list(colours.values()) if isinstance(colours, dict) else colours
        return float(np.mean(255 - np.reshape(flat, (-1, 3))))

    dimmed = size("static_target")
    for cloud in ("source", "target"):
        assert len(tab.points(cloud)) > 20
        assert len(tab.points(f"static_{cloud}")) > 500
        assert size(f"static_{cloud}") < 0.8 * size(cloud)
        assert contrast(f"static_{cloud}") < 0.7 * contrast(cloud)
    tab.show("View")
    tab.choose_option("Static scene", "Shown")
    tab.until(lambda: size("static_target") > 1.3 * dimmed)
    tab.choose_option("Static scene", "Hidden")
    tab.until(lambda: not len(tab.points("static_target")) and not len(tab.points("static_source")))
    assert len(tab.points("target")) > 20
