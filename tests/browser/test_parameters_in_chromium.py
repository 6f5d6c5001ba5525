"""Undo, presets and parameter files in a real Chromium."""

import json
from pathlib import Path

import numpy as np
from playwright.sync_api import Locator

from tests.browser.tab import Tab


def field(tab: Tab, label: str) -> Locator:
    """The field for the number of a control."""
    return tab.row(label).locator("input:not([type=hidden])")


def test_a_drag_is_undone_and_redone_with_keys(tab: Tab):
    arrows = len(tab.arrows())
    tab.set_slider("δ", "ArrowRight", times=3)
    tab.set_slider("δ", "End")
    tab.until(lambda: len(tab.arrows()) == 0)
    tab.page.keyboard.press("Control+z")
    tab.until(lambda: tab.value("δ") == 0.04 and len(tab.arrows()) == arrows)
    tab.page.keyboard.press("Control+Shift+Z")
    tab.until(lambda: tab.value("δ") == 0.5 and len(tab.arrows()) == 0)


def test_a_preset_survives_a_reload_and_a_file_goes_out_and_in(tab: Tab, tmp_path: Path):
    tab.set_slider("δ", "End")
    tab.until(lambda: len(tab.arrows()) == 0)
    tab.show("More")
    tab.row("Name").locator("input").fill("nothing moves")
    tab.page.wait_for_timeout(100)
    tab.page.get_by_role("button", name="Save", exact=True).click()
    tab.until((tmp_path / "tofscope" / "presets" / "nothing moves.json").exists)
    with tab.page.expect_download() as download:
        tab.page.get_by_role("button", name="Save parameters as a file").click()
    content = json.loads(Path(download.value.path()).read_text())
    assert content["delta"] == 0.5

    tab.page.get_by_role("button", name="δ", exact=True).click()
    tab.until(lambda: tab.value("δ") == 0.04)
    tab.page.reload()
    tab.until(lambda: tab.value("δ") == 0.04)
    tab.page.get_by_role("button", name="Load", exact=True).click()
    tab.until(lambda: tab.value("δ") == 0.5)

    file = tmp_path / "mine.json"
    file.write_text(json.dumps({**content, "delta": 0.1, "n": 5}))
    tab.page.set_input_files("input[type=file]", file)
    tab.until(lambda: tab.value("δ") == 0.1 and tab.value("n") == 5)


def test_a_number_beyond_its_range_becomes_the_nearest_in_it_and_the_page_says_so(tab: Tab):
    number, said = field(tab, "n"), tab.page.locator("#tofscope-rule", has_text="became")
    rule = tab.page.locator("#tofscope-rule")
    number.click()
    tab.until(lambda: rule.inner_text().startswith("Whole numbers from 1 to 20 frames;"))
    tab.page.keyboard.press("Control+a")
    tab.page.keyboard.type("1.5")
    assert number.input_value() == "1"  # and not 15
    assert rule.inner_text().startswith("What follows the point is left out.")
    number.fill("5000")
    tab.until(said.is_visible)
    assert said.inner_text() == "n goes from 1 to 20 frames: 5000 became 20."
    number.blur()
    tab.until(lambda: tab.value("n") == 20 and number.input_value() == "20")
    tab.until(lambda: tab.has_text("is before the start") or tab.has_text("1.333 s"))
    tab.page.wait_for_timeout(300)
    assert said.is_visible()
    number.fill("5")
    tab.until(lambda: not said.is_visible())
    number.blur()
    tab.page.wait_for_timeout(300)
    assert tab.value("n") == 5

    number = field(tab, "γ")
    number.fill("9")
    tab.until(said.is_visible)
    number.press("Enter")
    tab.until(lambda: len(tab.arrows()) == 0)
    tab.page.keyboard.press("Control+z")
    tab.until(lambda: tab.value("γ") == 0.7 and not said.is_visible())


def test_a_number_elsewhere_is_corrected_also_after_it_is_left(tab: Tab):
    tab.show("More")
    said = tab.page.locator("#tofscope-rule", has_text="became")
    number = field(tab, "min cluster size")
    number.fill("1")
    tab.until(said.is_visible)
    number.blur()
    tab.until(lambda: number.input_value() == "2")
    tab.page.wait_for_timeout(300)
    assert said.inner_text() == "min cluster size goes from 2 to 100000 points: 1 became 2."
    tab.page.get_by_role("button", name="others", exact=True).click()
    tab.until(lambda: number.input_value() == "20" and not said.is_visible())


def test_a_value_from_elsewhere_widens_its_slider_only_for_as_long_as_it_needs(
    tab: Tab, tmp_path: Path
):
    tab.show("More")
    file = tmp_path / "far.json"
    file.write_text(json.dumps({"n_min": 900}))
    tab.page.set_input_files("input[type=file]", file)

    def largest() -> str | None:
        return tab.slider("N_min").get_attribute("aria-valuemax")

    tab.until(lambda: tab.value("N_min") == 900 and largest() == "900")
    tab.page.get_by_role("button", name="undo", exact=True).click()
    tab.until(lambda: tab.value("N_min") == 60 and largest() == "200")


def test_a_number_that_is_left_empty_comes_back(tab: Tab):
    number = field(tab, "N_min")
    number.focus()
    number.fill("")
    number.blur()
    tab.until(lambda: number.input_value() == "60" and tab.value("N_min") == 60)


_FLOOD = """([slider, keys]) => new Promise(done => {
  const start = performance.now();
  const press = index => {
    if (index === keys.length) return done();
    slider.dispatchEvent(new KeyboardEvent("keydown", {key: keys[index], bubbles: true}));
    setTimeout(press, start + 1000 * (index + 1) / keys.length - performance.now(), index + 1);
  };
  press(0);
})"""


def test_200_slider_events_in_a_second_end_on_the_last(tab: Tab):
    keys = ["ArrowLeft", "ArrowRight"] * 98 + ["Home", "ArrowRight", "ArrowRight", "ArrowRight"]
    slider = tab.row("n").locator("[role=slider]")
    tab.page.evaluate(_FLOOD, [slider.element_handle(), keys])
    tab.until(lambda: tab.has_text("0.267 s"))
    tab.page.wait_for_timeout(700)  # nothing that was late comes after it
    assert tab.value("n") == 4
    assert tab.has_text("0.267 s")
    drawn = tab.arrows()
    tab.set_slider("n", "ArrowRight")
    tab.until(lambda: tab.has_text("0.333 s"))
    tab.set_slider("n", "ArrowLeft")
    tab.until(lambda: tab.has_text("0.267 s") and np.array_equal(tab.arrows(), drawn))
