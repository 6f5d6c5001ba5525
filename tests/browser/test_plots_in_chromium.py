from collections.abc import Iterator

import numpy as np
import pytest
from playwright.sync_api import BrowserContext, Page

from app.panels.plot_list import PLOTS
from app.server.server import Server
from tests.browser.tab import Tab

_DATA = """() => Object.values(window.__viserTestpoints.uplots)
  .map(({chart}) => chart.data.map(values => Array.from(values)))"""
_CURSOR = """() => parseFloat(getComputedStyle(document.querySelector('.u-over'), '::after').left)
  / document.querySelector('.u-over').clientWidth"""


@pytest.fixture(scope="module")
def first_tab(window: BrowserContext, server: Server) -> Iterator[Tab]:
    """A page that is wide enough for the plots to be open."""
    tab = Tab(window, server.address, {"width": 1280, "height": 720})
    yield tab
    tab.page.close()


def plots(page: Page) -> list[np.ndarray]:
    """The data of all plots: times, then the values of each line."""
    return [np.array(data, dtype=float) for data in page.evaluate(_DATA)]


def filled(tab: Tab) -> None:
    tab.until(lambda: tab.has_text("Means,"))


def test_the_whole_recording_is_plotted_and_a_change_of_parameters_plots_it_again(tab: Tab):
    tab.open("robot_moving")
    filled(tab)
    shown = plots(tab.page)
    assert len(shown) == len(PLOTS)
    last = int(tab.row("Frame").locator("[role=slider]").get_attribute("aria-valuemax") or 0)
    assert all(len(data[0]) == last + 1 for data in shown)
    moving = max(shown, key=lambda data: np.nanmax(data[1]))[1]
    assert np.isnan(moving[:8]).all()
    assert np.nanmax(moving) > 50
    tab.set_slider("δ", "End")
    tab.until(lambda: max(np.nan_to_num(data[1:]).max() for data in plots(tab.page)) <= 1)


def test_a_click_in_a_plot_goes_there_and_the_line_follows(tab: Tab):
    filled(tab)
    last = int(tab.row("Frame").locator("[role=slider]").get_attribute("aria-valuemax") or 0)
    field = tab.row("Go to [s]").locator("input:not([type=hidden])")
    for share in (0.75, 0.75, 0.4):
        plot = tab.page.locator(".u-over").nth(1)
        box = plot.bounding_box()
        assert box is not None
        tab.page.mouse.click(box["x"] + share * box["width"], box["y"] + box["height"] / 2)
        tab.until(lambda share=share: abs(tab.value("Frame") - share * last) < 1)
        frame = tab.value("Frame")
        tab.until(lambda frame=frame: abs(tab.page.evaluate(_CURSOR) - frame / last) < 0.02)
        tab.set_slider("Frame", "Home")
        tab.until(lambda: tab.page.evaluate(_CURSOR) < 0.01)
        tab.until(lambda: float(field.input_value()) == 0)


def test_a_time_can_be_typed_and_typed_again(tab: Tab):
    field = tab.row("Go to [s]").locator("input:not([type=hidden])")
    for _ in range(2):
        tab.set_slider("Frame", "Home")
        tab.until(lambda: tab.value("Frame") == 0 and float(field.input_value()) == 0)
        field.click()
        field.press("Control+a")
        field.press_sequentially("1.25", delay=150)
        tab.until(lambda: tab.has_text("at 1.27 s") or tab.has_text("at 1.20 s"))
        assert field.input_value() == "1.25"
        field.blur()
        tab.page.wait_for_timeout(300)
        assert field.input_value() == "1.25"


def test_the_numbers_arrive_as_a_csv_file(tab: Tab):
    filled(tab)
    with tab.page.expect_download() as download:
        tab.page.get_by_role("button", name="Save as CSV").click()
    assert download.value.suggested_filename.endswith("_plots.csv")
    lines = download.value.path().read_text().splitlines()
    assert lines[0].startswith("# Tofscope; recording ")
    assert "; simulated; n=8; gamma=0.7;" in lines[0]
    assert "frames computed" not in lines[0]
    assert "angle deviation [deg]" in lines[1]
    last = int(tab.row("Frame").locator("[role=slider]").get_attribute("aria-valuemax") or 0)
    assert len(lines) == last + 3


def test_the_legend_of_the_scene_lies_beside_the_plots(tab: Tab):
    tab.until(lambda: tab.page.locator("[data-legend]").count() == 1)
    legend = tab.page.locator("[data-legend]")

    def beside() -> bool:
        # A plot that is being built anew has no place for a moment.
        box, plot = legend.bounding_box(), tab.page.locator(".uplot").first.bounding_box()
        return box is not None and plot is not None and box["x"] > plot["x"] + plot["width"]

    tab.until(beside)
