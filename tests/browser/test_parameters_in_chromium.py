"""Undo, presets and files of parameters in a real Chromium."""

import json
from pathlib import Path

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
