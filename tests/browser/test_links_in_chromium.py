"""Links and reloads in a real Chromium."""

import numpy as np
import pytest
from playwright.sync_api import Browser, BrowserContext

from app.server.server import Server
from tests.browser.conftest import NO_DRAWING
from tests.browser.tab import Tab

_CAMERA = "Array.from(window.__viserMutable.camera.matrixWorld.elements)"


def camera(tab: Tab) -> np.ndarray:
    return np.array(tab.page.evaluate(_CAMERA)).reshape(4, 4)


def move_camera(tab: Tab) -> np.ndarray:
    before = camera(tab)
    tab.page.mouse.move(200, 300)
    tab.page.mouse.down()
    tab.page.mouse.move(300, 350, steps=5)
    tab.page.mouse.up()
    tab.until(lambda: not np.allclose(camera(tab), before, atol=0.05))
    tab.page.wait_for_timeout(1500)  # until it has come to rest, and the server knows
    return camera(tab)


def test_a_link_leads_another_tab_to_the_same_place(
    tab: Tab, context: BrowserContext, server: Server
):
    context.grant_permissions(["clipboard-read", "clipboard-write"])
    tab.open("sideways")
    tab.set_slider("n", "ArrowLeft", times=2)
    tab.set_slider("Frame", "ArrowLeft", times=3)
    seen, frame = move_camera(tab), tab.value("Frame")
    tab.page.get_by_role("button", name="Copy link").click()
    tab.until(lambda: tab.page.get_by_role("alert").filter(has_text="It is copied").count() > 0)
    link = tab.page.evaluate("navigator.clipboard.readText()")
    assert link.startswith(f"{server.address}/?link=")

    other = Tab(context, link)
    other.until(lambda: other.has_text("Simulated: sideways"))
    other.until(lambda: other.value("n") == 6 and other.value("Frame") == frame)
    other.page.wait_for_timeout(1500)
    np.testing.assert_allclose(camera(other), seen, atol=0.01)
    # A reload comes back to what was shown last, and not to the link.
    assert "link" not in other.page.url
    other.set_slider("n", "ArrowLeft")
    other.until(lambda: other.value("n") == 5)
    other.page.reload()
    other.until(lambda: other.has_text("Moving") and other.value("n") == 5)


def test_a_reload_keeps_camera_and_view(tab: Tab):
    tab.page.get_by_text("Colours, sizes, layers").click()
    tab.set_slider("Arrow scale", "ArrowRight", times=2)
    scale, seen = tab.value("Arrow scale"), move_camera(tab)
    tab.page.reload()
    tab.page.get_by_text("Colours, sizes, layers").click()
    tab.until(lambda: tab.has_text("Moving") and len(tab.arrows()) > 0)
    tab.until(lambda: tab.value("Arrow scale") == scale)
    tab.page.wait_for_timeout(1500)
    np.testing.assert_allclose(camera(tab), seen, atol=0.01)


def test_a_damaged_link_is_told(context: BrowserContext, server: Server):
    tab = Tab(context, f"{server.address}/?link=nonsense")
    tab.until(lambda: tab.page.get_by_role("alert").filter(has_text="link is damaged").count() > 0)


SURROGATE = "eyJyZWNvcmRpbmciOiJcdWQ4MDAiLCJmcmFtZSI6MCwicGFyYW1ldGVycyI6e319"
"""{"recording": a lone surrogate, "frame": 0, "parameters": {}}"""

_RUBBISH = """link => {
  const odd = ["", "\\ud800", "[".repeat(100000), "x".repeat(1000000), "{\\"a\\": 1}", link];
  odd.forEach((value, k) => {
    for (const key of ["link", "session", "answer-" + k])
      localStorage.setItem("viser-user:" + key, value);
  });
  sessionStorage.setItem("tofscope-session", "\\ud800".repeat(100000));
}"""


@pytest.fixture
def fresh(chromium: Browser):
    """A window whose storage is its own."""
    window = chromium.new_context()
    window.set_default_timeout(10_000)
    window.add_init_script(NO_DRAWING)
    yield window
    window.close()


def test_a_link_that_cannot_be_encoded_leaves_the_app_as_it_is(
    fresh: BrowserContext, server: Server
):
    tab = Tab(fresh, f"{server.address}/?link={SURROGATE}")  # waits for arrows
    tab.until(lambda: tab.page.get_by_role("alert").filter(has_text="link is damaged").count() > 0)
    kept = "Object.keys(localStorage).filter(key => key.startsWith('viser-user:'))"
    tab.until(lambda: not tab.page.evaluate(kept))
    tab.page.close()
    again = Tab(fresh, server.address)
    assert again.page.get_by_role("alert").filter(has_text="damaged").count() == 0


def test_whatever_a_browser_keeps_the_page_comes_up(fresh: BrowserContext, server: Server):
    tab = Tab(fresh, server.address)
    tab.page.evaluate(_RUBBISH, SURROGATE)
    tab.page.reload()
    tab.until(lambda: tab.has_text("Moving") and len(tab.arrows()) > 0)
    alerts = tab.page.get_by_role("alert").all_inner_texts()
    assert not [said for said in alerts if "link" in said or "anew" in said]
