"""The plots in a real Chromium: one cursor, zoom, A over B, files."""

from typing import Any

import numpy as np
import pytest

from app.panels.plot_list import PLOTS
from app.panels.plot_words import HOLLOW
from tests.browser.tab import Tab

_VALUES = "([name, side]) => Array.from(tofscope.plotData.values(name, side))"
_SAID = """() => [...document.querySelectorAll('.plots-list .plot-heading')].map(heading => [
  heading.querySelector('.plot-title').textContent,
  ...[...heading.querySelectorAll('.plot-value')].map(value => value.textContent)])"""
_DOTS = """() => [...document.querySelectorAll('.plots-list .plot-heading')].map(heading =>
  [...heading.querySelectorAll('.plot-dot')].map(dot => dot.style.background))"""
_LINES = """kind => [...document.querySelectorAll(`.plot-line${kind}`)]
  .filter(line => line.style.display === 'block').map(line => parseFloat(line.style.left))"""
_SENT = """() => {
  const tell = tofscope.tell;
  window.sentByPlots = 0;
  tofscope.tell = (kind, data) => {
    window.sentByPlots += kind.startsWith("plots.");
    tell(kind, data);
  };
}"""


@pytest.fixture
def tab(wide_tab: Tab) -> Tab:
    return wide_tab


class Plots:
    """The plots of a page, whose numbers are all there."""

    def __init__(self, tab: Tab) -> None:
        self.tab, self.page = tab, tab.page
        tab.until(lambda: tab.has_text("pairs count"))

    def state(self, name: str) -> Any:
        return self.page.evaluate(f"tofscope.plots.state.{name}")

    def values(self, name: str, side: str = "A") -> np.ndarray:
        found = self.page.evaluate(_VALUES, [name, side])
        return np.array([np.nan if value is None else value for value in found], dtype=float)

    def said(self) -> list[list[str]]:
        """Title and values of each plot, at the pointer or at the frame."""
        return self.page.evaluate(_SAID)

    def place(self, name: str, share: float) -> tuple[float, float]:
        """Point of a plot, at a share of the time that is shown."""
        box = self.page.locator(f"[data-plot={name}]").bounding_box()
        assert box is not None
        return box["x"] + 44 + share * (box["width"] - 52), box["y"] + 20

    def hover(self, name: str, share: float) -> None:
        self.page.mouse.move(*self.place(name, share))

    def drag(self, name: str, start: float, end: float) -> None:
        self.hover(name, start)
        self.page.mouse.down()
        x, y = self.place(name, end)
        self.page.mouse.move(x, y, steps=4)
        self.page.mouse.up()

    def distance_of_values(self, name: str, share: float) -> float:
        """Pixels between the cursor in an enlarged plot and the values beside it."""
        self.hover(name, share)
        self.tab.until(lambda: self.state("hovered") is not None)
        self.page.wait_for_timeout(100)
        said = self.page.locator(f"[data-plot={name}] .plot-values").bounding_box()
        cursor, _ = self.place(name, share)
        assert said is not None
        return min(abs(said["x"] - cursor), abs(said["x"] + said["width"] - cursor))

    def canvas(self, name: str) -> bytes:
        return self.page.locator(f"[data-plot={name}] canvas").screenshot()


def test_one_cursor_with_all_values_and_zoom_in_all_plots(tab: Tab):
    plots = Plots(tab)
    assert HOLLOW in tab.page.content()
    times, errors = plots.values("time"), plots.values("angle_deg")
    last = len(times) - 1
    for name in PLOTS:
        assert len(plots.values(name)) == last + 1
    assert np.isnan(plots.values("moving")[:8]).all()
    assert np.nanmax(plots.values("moving")) > 50

    # Hovering one plot says the values of all at that time, and asks the server nothing.
    at_rest = plots.said()
    tab.page.evaluate(_SENT)
    counts = np.array(tab.page.evaluate("Array.from(tofscope.plotData.counts('A'))"))
    hollow = int(np.flatnonzero(np.isfinite(errors) & (counts == 0))[0])
    plots.hover("speed", times[hollow] / times[-1])
    tab.until(lambda: plots.state("hovered") == hollow)
    said = {title: values for title, *values in plots.said()}
    assert said["Angle deviation [°]"] == [f"{errors[hollow]:.2f}"]
    assert said["Moving points"] == [f"{plots.values('moving')[hollow]:.0f}"]
    assert len(said["Speed [m/s]"]) == 2
    assert f"Frame {hollow} · {times[hollow]:.3f} s" in tab.page.inner_text(".plots-where")
    assert all(dots[0] == "none" for dots in tab.page.evaluate(_DOTS))  # hollow, as the point
    lines = tab.page.evaluate(_LINES, ".hovered")
    assert len(lines) == len(PLOTS)
    assert len(set(lines)) == 1
    tab.page.mouse.move(640, 300)
    tab.until(lambda: plots.state("hovered") is None)
    assert plots.said() == at_rest
    assert tab.page.evaluate("window.sentByPlots") == 0

    # A drag zooms all of them, whatever arrives meanwhile; a double click shows all again.
    whole = [plots.canvas(name) for name in PLOTS]
    frame = plots.state("frame")
    plots.drag("angle_deg", 0.4, 0.7)
    tab.until(lambda: plots.state("view") is not None)
    low, high = plots.state("view")
    assert low == pytest.approx(0.4 * times[-1], abs=0.05)
    assert high == pytest.approx(0.7 * times[-1], abs=0.05)
    tab.page.wait_for_timeout(200)
    assert all(plots.canvas(name) != before for name, before in zip(PLOTS, whole, strict=True))
    tab.set_slider("δ", "End")
    tab.until(lambda: np.nanmax(plots.values("moving"), initial=0) <= 1)
    assert plots.state("view") == [low, high]
    tab.page.mouse.dblclick(*plots.place("coverage", 0.5))
    tab.until(lambda: plots.state("view") is None)
    tab.page.wait_for_timeout(400)
    assert plots.state("frame") == frame  # a double click goes nowhere


def test_a_click_goes_there_and_the_line_follows(tab: Tab):
    plots = Plots(tab)
    times = plots.values("time")
    for share in (0.75, 0.4, 0.0):
        frame = round(share * (len(times) - 1))
        tab.page.mouse.click(*plots.place("speed", share))
        tab.until(lambda frame=frame: abs(plots.state("frame") - frame) <= 1)
        tab.page.mouse.move(640, 300)
        now = plots.state("frame")
        tab.until(lambda now=now: f"Frame {now} · " in tab.page.inner_text(".plots-where"))
        lines = tab.page.evaluate(_LINES, ":not(.hovered)")
        assert len(lines) == len(PLOTS)
        x, _ = plots.place("speed", times[now] / times[-1])
        left, _ = plots.place("speed", 0.0)
        assert abs(lines[0] - 44 - (x - left)) < 2


def test_a_and_b_are_drawn_over_each_other_and_compared_over_the_recording(tab: Tab):
    plots = Plots(tab)
    tab.show("Compare")
    tab.page.get_by_role("button", name="Copy A to B").click()
    tab.until(lambda: plots.state("shown") == ["A", "B"])
    tab.set_slider("n", "ArrowLeft", times=3)
    tab.until(lambda: np.isfinite(plots.values("moving", "B")[5:]).all())
    assert np.isnan(plots.values("moving", "A")[:8]).all()
    tab.until(lambda: tab.page.inner_text("[data-plot=angle_deg] >> xpath=..").count("; B ") > 0)
    said = {title: values for title, *values in plots.said()}
    assert len(said["Angle deviation [°]"]) == 2
    assert len(said["Speed [m/s]"]) == 3
    mean = tab.page.locator(".plot-note").nth(2).inner_text()
    assert mean.startswith("Mean A ")
    assert "pairs count; B " in mean
    tab.until(lambda: not tab.has_text("Whole recording so far"))
    table = tab.page.locator("table", has_text="Whole recording").first
    rows = [row.split("\t") for row in table.inner_text().splitlines()]
    cells = {row[0]: row[1:] for row in rows}
    moving = [np.nansum(plots.values("moving", side)) for side in "AB"]
    assert cells["Moving"][2:] == [f"{total:.0f}" for total in moving]
    assert " of " in cells["Pairs that count"][2]
    assert table.locator("b").count() > 0  # the better ones
    tab.page.get_by_role("button", name="Remove B").click()
    tab.until(lambda: plots.state("shown") == ["A"])


def test_plots_as_large_as_the_window_or_the_panel_and_two_quantities(tab: Tab):
    plots, page = Plots(tab), tab.page
    frame, narrow = plots.state("frame"), page.locator("[data-plot=speed]").bounding_box()
    assert narrow is not None
    page.get_by_role("button", name="Enlarge").click()
    tab.until(lambda: plots.state("enlarged"))
    page.wait_for_timeout(200)
    wide = page.locator("[data-plot=speed]").bounding_box()
    assert wide is not None
    assert wide["width"] > 1000
    labelled = page.evaluate("tofscope.plots.state.plots.map(plot => plot.labelled)")
    assert labelled == [False] * (len(PLOTS) - 1) + [True]  # one time axis, below all
    assert HOLLOW in page.inner_text(".plots-about")
    lowest = page.locator(f"[data-plot={PLOTS[-1]}]").bounding_box()
    assert lowest is not None
    assert 600 < lowest["y"] + lowest["height"] <= 720
    for share in (0.3, 0.7):
        assert plots.distance_of_values("moving", share) < 60
    page.keyboard.press("Escape")
    tab.until(lambda: not plots.state("enlarged"))
    page.mouse.move(640, 300)
    page.wait_for_timeout(200)
    assert page.locator("[data-plot=speed]").bounding_box() == narrow
    assert plots.state("frame") == frame

    # The panel's own handle makes it wider, and the plots with it.
    edge = page.locator("canvas[data-engine]").bounding_box()
    assert edge is not None
    page.mouse.move(edge["x"], 400)
    page.mouse.down()
    page.mouse.move(edge["x"] + 120, 400, steps=5)
    page.mouse.up()

    def grown() -> bool:
        box = page.locator("[data-plot=speed]").bounding_box()
        return box is not None and box["width"] > narrow["width"] + 80

    tab.until(grown)

    for row, quantity in (("Plot", "Angle deviation [°]"), ("against", "Moving points")):
        tab.row(row).locator("input").first.click()
        page.locator("[role=option]:visible", has_text=quantity).click()
    tab.until(lambda: tab.has_text("Angle deviation [°] against Moving points"))
    page.locator("[data-plot=pair]").scroll_into_view_if_needed()
    tab.until(page.locator("[data-plot=pair] .plot-ring").first.is_visible)
    ring = page.locator("[data-plot=pair] .plot-ring").first.bounding_box()
    assert ring is not None
    page.mouse.move(ring["x"] + 5, ring["y"] + 5)
    tab.until(lambda: plots.state("hovered") == frame)
    both = f"({plots.values('moving')[frame]:.0f}, {plots.values('angle_deg')[frame]:.2f})"
    tab.until(lambda: page.inner_text(".plots-across .plot-values") == both)

    page.get_by_role("button", name="Enlarge").click()
    tab.until(lambda: plots.state("enlarged"))
    page.wait_for_timeout(200)
    assert 600 < _height(tab, "pair") < 720  # beside the others, as high as all of them


def _height(tab: Tab, name: str) -> float:
    box = tab.page.locator(f"[data-plot={name}]").bounding_box()
    assert box is not None
    return box["height"]


def test_the_plots_arrive_as_files(tab: Tab):
    plots = Plots(tab)
    last = len(plots.values("time")) - 1
    with tab.page.expect_download() as download:
        tab.page.get_by_role("button", name="CSV", exact=True).click()
    assert download.value.suggested_filename.endswith("_plots.csv")
    lines = download.value.path().read_text().splitlines()
    assert lines[0].startswith("# Tofscope; recording ")
    assert "; simulated; n=8; gamma=0.7;" in lines[0]
    assert "frames computed" not in lines[0]
    assert "angle deviation [deg]" in lines[1]
    assert len(lines) == last + 3
    with tab.page.expect_download(timeout=60_000) as download:
        tab.page.get_by_role("button", name="SVG", exact=True).click()
    svg = download.value.path().read_text()
    assert "Angle deviation [°]: mean " in svg
    assert "(simulated: " in svg


def test_the_legend_of_the_scene_lies_beside_the_plots(tab: Tab):
    tab.until(lambda: tab.page.locator("[data-legend]").count() == 1)
    legend = tab.page.locator("[data-legend]")

    def beside() -> bool:
        box, plot = legend.bounding_box(), tab.page.locator(".plot-area").first.bounding_box()
        return box is not None and plot is not None and box["x"] > plot["x"] + plot["width"]

    tab.until(beside)
