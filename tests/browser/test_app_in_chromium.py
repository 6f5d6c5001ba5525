from pathlib import Path

import numpy as np
from PIL import Image
from playwright.sync_api import BrowserContext

from app.server.server import Server
from tests.browser.tab import Tab


def test_24_frustums_follow_the_arm(tab: Tab):
    tab.open("robot_moving")
    names = tab.frustums()
    assert len(names) == 24
    sensors, link = [f"frustums/{name}" for name in names], tab.node("robot", "panda_link7")
    tab.set_slider("Frame", "Home")
    tab.until(lambda: tab.is_at(0))
    before, hand = tab.poses(sensors), tab.poses([link])
    tab.set_slider("Frame", "End")
    tab.until(lambda: not np.allclose(tab.poses([link]), hand))
    tab.page.wait_for_timeout(300)
    after, hand_after = tab.poses(sensors), tab.poses([link])
    ring = [i for i, name in enumerate(names) if "_end_effector_" in name]
    base = [i for i, name in enumerate(names) if "_base_" in name]
    assert len(ring) == len(base) == 8
    np.testing.assert_allclose(after[base], before[base], atol=1e-6)
    # The ring on the end-effector moves with link 7, rigidly.
    motion = hand_after[0] @ np.linalg.inv(hand[0])
    assert np.linalg.norm(motion[:3, 3]) > 0.01
    np.testing.assert_allclose(after[ring], motion @ before[ring], atol=1e-4)


def test_delta_at_its_largest_leaves_no_arrow_and_back_brings_them_again(tab: Tab):
    before = tab.arrows()
    tab.set_slider("δ", "End")
    tab.until(lambda: len(tab.arrows()) == 0)
    tab.set_slider("δ", "Home")
    tab.set_slider("δ", "ArrowRight", times=8)
    tab.until(lambda: tab.value("δ") == 0.04 and len(tab.arrows()) == len(before))
    # Where they end: where their shafts begin follows the size of points in the window.
    np.testing.assert_array_equal(tab.arrows()[:, 1], before[:, 1])


def test_n_changes_the_source_and_not_the_target(tab: Tab):
    source, target = tab.points("source"), tab.points("target")
    tab.set_slider("n", "ArrowLeft", times=3)
    tab.until(lambda: tab.value("n") == 5 and not np.array_equal(tab.points("source"), source))
    tab.until(lambda: tab.has_text("0.333 s"))
    np.testing.assert_array_equal(tab.points("target"), target)


def test_scrubbing_changes_both_clouds(tab: Tab):
    source, target = tab.points("source"), tab.points("target")
    tab.set_slider("Frame", "ArrowLeft", times=2)
    tab.until(lambda: not np.array_equal(tab.points("target"), target))
    tab.until(lambda: not np.array_equal(tab.points("source"), source))


def test_keys_step_and_play(tab: Tab):
    frame = tab.value("Frame")
    tab.page.locator("canvas[data-engine]").click()
    tab.page.keyboard.press("l")
    tab.until(lambda: tab.value("Frame") == frame + 1)
    tab.page.keyboard.press("j")
    tab.until(lambda: tab.value("Frame") == frame)
    tab.page.keyboard.press("Space")  # again and again, as a short recording is played
    tab.until(lambda: tab.value("Frame") > frame + 2)
    tab.page.get_by_role("button", name="Pause", exact=True).wait_for()
    tab.page.keyboard.press("r")  # no loop
    tab.until(lambda: tab.is_at(38))
    tab.page.get_by_role("button", name="Play", exact=True).wait_for()


def test_two_clients_keep_different_parameters(tab: Tab, context: BrowserContext, server: Server):
    other = Tab(context, server.address)
    count = len(tab.arrows())
    other.set_slider("δ", "End")
    other.until(lambda: len(other.arrows()) == 0)
    other.set_slider("Frame", "Home")
    other.until(lambda: other.has_text("No pair"))
    assert tab.value("δ") == 0.04
    assert len(tab.arrows()) == count
    assert not tab.has_text("No pair")


def test_a_bad_file_is_told_and_the_app_goes_on(tab: Tab):
    target = tab.points("target")
    tab.choose("zz_bad")
    told = tab.page.get_by_role("alertdialog").filter(has_text="zz_bad.mcap")
    told.wait_for()
    told.get_by_role("button", name="Close").click()
    np.testing.assert_array_equal(tab.points("target"), target)
    tab.open("towards")
    tab.set_slider("Frame", "ArrowLeft", times=2)
    tab.until(lambda: not np.array_equal(tab.points("target"), target))


def test_a_screenshot_arrives_as_a_png_file(tab: Tab):
    tab.show("Export")
    with tab.page.expect_download() as download:
        tab.page.get_by_role("button", name="Save screenshot").click()
    assert download.value.suggested_filename.endswith(f"_frame_{int(tab.value('Frame')):04d}.png")
    with Image.open(download.value.path()) as picture:
        assert picture.format == "PNG"
        assert picture.width > 300


def test_the_app_makes_an_offline_page_while_the_session_goes_on(tab: Tab):
    frame = tab.value("Frame")
    tab.show("Export")
    with tab.page.expect_download() as download:
        tab.page.get_by_role("button", name="Save offline page").click()
        tab.set_slider("Frame", "ArrowLeft", times=2)
    assert tab.value("Frame") == frame - 2
    name = download.value.suggested_filename
    assert name.endswith(".html")
    tab.until(lambda: tab.has_text(f"{name}, "))
    page = Path(download.value.path()).read_text()
    assert f"<title>{name.removesuffix('.html')} (simulated)</title>" in page
    assert "__VISER_EMBED_DATA__" in page
