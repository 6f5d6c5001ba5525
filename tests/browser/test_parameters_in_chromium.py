"""Undo, presets and parameter files in a real Chromium."""

import json
from pathlib import Path

import numpy as np

from tests.browser.tab import Tab


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
    tab.page.get_by_text("Presets", exact=True).click()
    tab.row("Name").locator("input").fill("nothing moves")
    tab.page.wait_for_timeout(100)
    tab.page.get_by_role("button", name="Save", exact=True).click()
    tab.until((tmp_path / "tofscope" / "presets" / "nothing moves.json").exists)
    with tab.page.expect_download() as download:
        tab.page.get_by_role("button", name="Save as a file").click()
    content = json.loads(Path(download.value.path()).read_text())
    assert content["delta"] == 0.5

    tab.page.get_by_role("button", name="δ", exact=True).click()
    tab.until(lambda: tab.value("δ") == 0.04)
    tab.page.reload()
    tab.page.get_by_text("Presets", exact=True).click()
    tab.until(lambda: tab.value("δ") == 0.04)
    tab.page.get_by_role("button", name="Load", exact=True).click()
    tab.until(lambda: tab.value("δ") == 0.5)

    file = tmp_path / "mine.json"
    file.write_text(json.dumps({**content, "delta": 0.1, "n": 5}))
    tab.page.set_input_files("input[type=file]", file)
    tab.until(lambda: tab.value("δ") == 0.1 and tab.value("n") == 5)


def test_more_than_a_slider_offers_can_be_typed(tab: Tab):
    number = tab.row("n").locator("input:not([type=hidden])")
    number.fill("25")
    tab.until(lambda: tab.has_text("is before the start"))
    tab.until(lambda: tab.row("n").locator("[role=slider]").get_attribute("aria-valuemax") == "25")
    number.blur()
    tab.page.wait_for_timeout(300)
    assert tab.value("n") == 25
    assert number.input_value() == "25"


def test_a_number_out_of_range_is_refused_in_words_and_the_old_one_comes_back(tab: Tab):
    number = tab.row("n").locator("input:not([type=hidden])")
    refusal = tab.page.get_by_text("must be")
    number.fill("5000")
    tab.until(refusal.is_visible)
    number.blur()
    tab.until(lambda: tab.value("n") == 8 and number.input_value() == "8")
    tab.page.wait_for_timeout(300)
    assert "5000" in refusal.inner_text()
    number.fill("20")
    tab.until(lambda: not refusal.is_visible())
    number.blur()
    tab.page.wait_for_timeout(300)
    assert tab.value("n") == 20


def test_a_folded_number_out_of_range_is_refused_also_after_it_is_left(tab: Tab):
    tab.page.get_by_text("More parameters", exact=True).click()
    number = tab.row("min cluster size").locator("input:not([type=hidden])")
    refusal = tab.page.get_by_text("must be")
    number.fill("1")
    tab.until(refusal.is_visible)
    number.blur()
    tab.page.wait_for_timeout(500)
    assert "min_cluster_size must be between 2" in refusal.inner_text()
    assert number.input_value() == "1"
    tab.page.get_by_role("button", name="Reset these").click()
    tab.until(lambda: number.input_value() == "20" and not refusal.is_visible())


def test_a_number_that_is_left_empty_comes_back(tab: Tab):
    number = tab.row("N_min").locator("input:not([type=hidden])")
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
