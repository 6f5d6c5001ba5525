"""Links and reloads in a real Chromium."""

import numpy as np
from playwright.sync_api import BrowserContext

from app.scene.scene_root import FIXED
from app.server.server import Server
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
    tab.show("Compare")
    tab.page.get_by_role("button", name="Copy A to B").click()
    tab.until(lambda: tab.has_text("Parameters of B"))
    tab.set_slider("n", "ArrowLeft", times=2)
    tab.set_slider("Frame", "ArrowLeft", times=3)
    seen, frame = move_camera(tab), tab.value("Frame")
    tab.show("Export")
    tab.page.get_by_role("button", name="Copy link").click()
    tab.until(
        lambda: tab.page.get_by_role("alert").filter(has_text="It is in the clipboard").count() > 0
    )
    link = tab.page.evaluate("navigator.clipboard.readText()")
    assert link.startswith(f"{server.address}/?link=")

    other = Tab(context, link)
    other.until(lambda: other.has_text("Simulated: sideways"))
    other.until(lambda: other.value("n") == 6 and other.value("Frame") == frame)
    other.page.wait_for_timeout(1500)
    np.testing.assert_allclose(camera(other), seen, atol=0.01)
    other.show("Compare")
    other.until(lambda: other.has_text("From A to B: n: 8 → 6"))
    # A reload comes back to what was shown last, and not to the link.
    assert "link" not in other.page.url
    other.set_slider("n", "ArrowLeft")
    other.until(lambda: other.value("n") == 5 and other.has_text("0.333 s"))  # estimated, too
    other.page.reload()
    other.until(lambda: other.has_text("Moving") and other.value("n") == 5)


_DRAWN = """names => names.map(name => {
  const {points, colors} = window.__viserSceneTree.getState()[name].message.props;
  return [Array.from(points), Array.from(Object.values(colors))];
})"""
_SHOWN = "name => window.__viserSceneTree.getState()[name]?.effectiveVisibility !== false"


def drawn(tab: Tab) -> list[np.ndarray]:
    """Points and colours of the flow of A and of B, and of the picked cluster."""
    names = [f"{FIXED}/{name}" for name in ("flow", "second_flow", "target", "picked/points")]
    return [
        np.array(values, dtype=float)
        for node in tab.page.evaluate(_DRAWN, names)
        for values in node
    ]


def chosen(tab: Tab) -> dict[str, str]:
    """What is chosen in the tabs."""
    found = {}
    for name, labels in (
        ("View", ("Colours", "Static scene", "Arrows show")),
        ("Explain", ("Cluster",)),
    ):
        tab.show(name)
        for label in labels:
            found[label] = tab.row(label).locator("input").first.input_value()
    tab.show("Compare")
    return found


def test_a_link_carries_colours_layers_the_picked_cluster_and_the_comparison(
    tab: Tab, context: BrowserContext
):
    context.grant_permissions(["clipboard-read", "clipboard-write"])
    tab.page.locator("tr[data-sets]", has_text="moving").click()
    tab.until(lambda: len(tab.points("picked/points")) > 20)
    tab.show("View")
    tab.choose_option("Colours", "Colour-blind safe")
    tab.choose_option("Static scene", "Shown")
    tab.row("Frustums").locator("input").click()
    frustum = f"{FIXED}/frustums/{tab.frustums()[0]}"
    tab.until(lambda: not tab.page.evaluate(_SHOWN, frustum))
    tab.show("Compare")
    tab.page.get_by_role("button", name="Copy A to B").click()
    tab.until(lambda: tab.has_text("Parameters of B"))
    tab.set_slider("n", "ArrowLeft", times=2)
    tab.page.get_by_text("Draw both", exact=True).click()
    tab.until(lambda: tab.value("n") == 6 and len(tab.points("second_flow")) > 20)
    tab.show("Export")
    tab.page.get_by_role("button", name="Copy link").click()
    alert = tab.page.get_by_role("alert").filter(has_text="It is in the clipboard")
    tab.until(lambda: alert.count() > 0)
    kept = chosen(tab)
    assert kept["Cluster"] != "none"

    other = Tab(context, tab.page.evaluate("navigator.clipboard.readText()"))
    other.until(lambda: other.value("n") == 6 and len(other.points("second_flow")) > 20)
    other.until(lambda: chosen(other) == kept)
    assert other.page.get_by_label("Draw both").is_checked()
    assert other.has_text("From A to B: n: 8 → 6")
    assert not other.page.evaluate(_SHOWN, frustum)
    other.until(
        lambda: all(
            one.shape == two.shape and np.allclose(one, two, atol=1e-3)
            for one, two in zip(drawn(other), drawn(tab), strict=True)
        )
    )


def test_a_reload_keeps_recording_frame_parameters_camera_and_view(tab: Tab):
    tab.open("sideways")
    tab.set_slider("n", "ArrowLeft", times=2)
    tab.set_slider("Frame", "ArrowLeft", times=3)
    tab.show("View")
    tab.set_slider("Arrow scale", "ArrowRight", times=2)
    scale, seen, frame = tab.value("Arrow scale"), move_camera(tab), tab.value("Frame")
    tab.page.reload()
    tab.until(lambda: tab.has_text("Simulated: sideways"))
    tab.until(lambda: tab.value("n") == 6 and tab.value("Frame") == frame)
    tab.until(lambda: tab.has_text("Moving") and len(tab.arrows()) > 0)
    tab.until(lambda: tab.value("Arrow scale") == scale)
    tab.page.wait_for_timeout(1500)
    np.testing.assert_allclose(camera(tab), seen, atol=0.01)


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


_FOLLOW = "token => history.replaceState(null, '', `/?link=${token}`)"
_KEPT = "Object.keys(localStorage).filter(key => key.startsWith('viser-user:'))"


def test_links_that_are_damaged_are_told_and_leave_the_app_as_it_is(tab: Tab):
    told = tab.page.get_by_role("alert").filter(has_text="link is damaged")
    for token in ("nonsense", SURROGATE):
        tab.page.evaluate(_FOLLOW, token)
        tab.begin_again()  # waits for arrows
        tab.until(lambda: told.count() > 0)
        tab.until(lambda: not tab.page.evaluate(_KEPT))
    tab.begin_again()
    tab.until(lambda: told.count() == 0)
    tab.page.wait_for_timeout(500)
    assert told.count() == 0


def test_whatever_a_browser_keeps_the_page_comes_up(tab: Tab):
    tab.page.evaluate(_RUBBISH, SURROGATE)
    try:
        tab.page.reload()
        tab.until(lambda: tab.has_text("Moving") and len(tab.arrows()) > 0)
        alerts = tab.page.get_by_role("alert").all_inner_texts()
        assert not [said for said in alerts if "link" in said or "anew" in said]
    finally:
        tab.page.evaluate("localStorage.clear()")
