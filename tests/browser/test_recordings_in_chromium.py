"""Choosing a recording in a real Chromium: the list, its keys, and what is said meanwhile."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import BrowserContext, Locator, Page, expect

from app.analysis.estimates import Estimates
from app.analysis.library import Library
from app.browser.guarded_server import GuardedServer
from app.browser.opening_card import front_page
from app.server.server import Server
from app.server.session import Shared
from app.session.reload import Reloads
from estimator import Parameters
from recordings import open_recording
from tests.browser.tab import Tab, until


def name(tab: Tab) -> str:
    button = tab.page.get_by_role("button", name=re.compile("^Recording: "))
    return (button.get_attribute("aria-label") or "").removeprefix("Recording: ")


def test_the_list_is_searched_by_parts_and_says_what_is_in_each(tab: Tab, recordings_folder: Path):
    page, rows = tab.page, tab.page.locator("#tofscope-recordings [role=option]:visible")
    tab.page.locator("canvas[data-engine]").click()
    page.keyboard.press("o")
    page.keyboard.type("l")  # at once: it is searched for, and no key of playback any more
    expect(page.get_by_label("Search recordings")).to_have_value("l")
    page.keyboard.press("Backspace")
    expect(rows).to_have_count(4)
    expect(page.get_by_label("Search recordings")).to_be_focused()
    # What each is.
    expect(tab.listed("towards")).to_contain_text(re.compile(r"trial 1.*2\.5 s.*39.*24.*yes"))
    bad = tab.listed("zz_bad")
    expect(bad.locator(".tofscope-reason")).to_have_text("It is not an MCAP file.")
    expect(bad).to_have_class(re.compile("unreadable"))
    # All parts of what is typed, in any case and order; keys are not playback's meanwhile.
    frame = tab.value("Frame")
    page.keyboard.type("25 TOW")
    expect(rows).to_have_count(1)
    page.keyboard.press("Control+a")
    page.keyboard.type("l nothing")
    expect(rows).to_have_count(0)
    page.keyboard.press("Control+a")
    page.keyboard.type("0.25")
    expect(rows).to_have_count(3)
    assert tab.value("Frame") == frame
    # Keys choose.
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Enter")
    expect(page.locator("#tofscope-recordings")).to_be_hidden()
    tab.until(lambda: name(tab) == "sideways_0.25_1")
    tab.until(lambda: tab.has_text("Simulated: sideways"))
    page.keyboard.press("l")  # playback's again
    tab.until(lambda: tab.has_text("Frame ") and tab.value("Frame") > 0)
    # What came later is there the next time.
    later = recordings_folder / "zz_later.mcap"
    later.write_bytes(b"nothing")
    try:
        page.keyboard.press("o")
        expect(rows).to_have_count(5, timeout=30_000)
        expect(rows.filter(has_text="open")).to_have_attribute("aria-selected", "true")
        page.keyboard.type("something")
        page.keyboard.press("Escape")
        expect(page.locator("#tofscope-recordings")).to_be_hidden()
    finally:
        later.unlink()


def test_keys_and_buttons_open_the_next_and_the_previous_one(tab: Tab):
    tab.page.locator("canvas[data-engine]").click()
    assert name(tab) == "robot_moving_0.25_1"
    tab.page.keyboard.press("n")
    tab.until(lambda: name(tab) == "sideways_0.25_1" and tab.has_text("Simulated: sideways"))
    tab.page.get_by_role("button", name="Next recording").click()
    tab.until(lambda: tab.has_text("Simulated: towards"))
    tab.page.keyboard.press("n")  # past a file that cannot be opened, there is none
    alert = tab.page.get_by_role("alert").filter(has_text="This is the last")
    tab.until(lambda: alert.count() or tab.has_text("cannot be opened"))
    assert name(tab) == "towards_0.25_1"
    tab.page.keyboard.press("Shift+N")
    tab.until(lambda: tab.has_text("Simulated: sideways"))


def test_a_bad_file_says_in_a_card_what_failed_why_and_what_to_do(tab: Tab):
    card = tab.page.locator("#tofscope-failure")
    for _ in range(2):  # each time
        tab.choose("zz_bad")
        expect(card).to_contain_text("zz_bad cannot be opened")
        expect(card).to_contain_text("It is not an MCAP file.")
        expect(card).to_contain_text("robot_moving_0.25_1 stays open.")
        expect(card).to_contain_text(re.compile("tofscope info .*zz_bad.mcap"))
        tab.page.keyboard.press("Escape")
        expect(card).to_be_hidden()
    assert name(tab) == "robot_moving_0.25_1"
    tab.choose("zz_bad")
    card.get_by_role("button", name="Choose another").click()
    expect(card).to_be_hidden()
    tab.listed("sideways").click()
    tab.until(lambda: tab.has_text("Simulated: sideways"))


def panel(page: Page) -> Locator:
    """A part of our panels that is there in every session."""
    return page.get_by_role("tab", name="Explain", exact=True)


def seen(page: Page) -> dict[str, object]:
    """What a person sees of the card, and of viser's and our panels."""
    return {
        "card": page.locator("#tofscope-opening").is_visible(),
        "panel": panel(page).is_visible(),
        "viser": [
            text
            for text in ("Inactive", "Connecting...", "Save Canvas", "Reset View", "Dev Settings")
            if page.get_by_text(text, exact=True).is_visible()
        ],
    }


_SAID = """() => {
  window.said = [];
  const card = document.getElementById("tofscope-opening");
  new MutationObserver(() => window.said.push(card.textContent)).observe(
    card, {childList: true, subtree: true, characterData: true});
}"""


def test_viser_s_panel_is_not_seen_while_there_is_nothing_to_show(context: BrowserContext):
    waiting = GuardedServer("127.0.0.1", 0, "label", page=lambda html: front_page(html, "Tofscope"))
    try:
        page = context.new_page()
        page.goto(f"http://127.0.0.1:{waiting.get_port()}", wait_until="commit")
        expect(page.locator("#tofscope-opening")).to_contain_text("Opening …")
        expect(page).to_have_title("Tofscope")
        until(page, lambda: len(waiting.get_clients()) == 1, timeout=30)
        page.wait_for_selector("canvas[data-engine]", state="attached")
        assert seen(page) == {"card": True, "panel": False, "viser": []}
    finally:
        waiting.stop()
    expect(page.locator("#tofscope-opening")).to_contain_text("The connection to Tofscope was lost")


def test_a_lost_connection_is_told_and_the_page_comes_back(server: Server, context: BrowserContext):
    page = context.new_page()
    page.goto(server.address)
    states: list[dict[str, object]] = []
    until(page, lambda: states.append(seen(page)) or states[-1]["panel"], timeout=30)
    assert [state["viser"] for state in states if state["viser"]] == []
    until(page, lambda: seen(page) == {"card": False, "panel": True, "viser": []})
    assert page.locator("svg.tabler-icon-adjustments:visible").count() == 0
    page.evaluate(_SAID)
    guarded = server._server
    ours = guarded._websock_server._live_connections[max(guarded.get_clients())]
    guarded.get_event_loop().call_soon_threadsafe(ours.transport.abort)
    said = "The connection to Tofscope was lost"
    until(page, lambda: any(said in text for text in page.evaluate("window.said")))
    until(page, lambda: seen(page) == {"card": False, "panel": True, "viser": []}, timeout=30)


def scheme(page: Page) -> str:
    return page.evaluate("document.documentElement.dataset.mantineColorScheme")


def test_the_page_is_dark_as_the_system_is_until_a_person_chooses(
    server: Server, context: BrowserContext
):
    page = context.new_page()
    page.emulate_media(color_scheme="dark")
    page.goto(server.address, wait_until="commit")
    expect(page.locator("#tofscope-opening")).to_have_css("background-color", "rgb(22, 24, 28)")
    until(page, panel(page).is_visible)
    until(page, lambda: scheme(page) == "dark")
    page.emulate_media(color_scheme="light")
    until(page, lambda: scheme(page) == "light")
    page.emulate_media(color_scheme="dark")
    until(page, lambda: scheme(page) == "dark")
    page.locator("canvas[data-engine]").click()
    page.keyboard.press("Control+k")
    page.get_by_placeholder("Search commands").fill("Dark or light")
    page.keyboard.press("Enter")
    until(page, lambda: scheme(page) == "light")
    page.emulate_media(color_scheme="light")
    page.emulate_media(color_scheme="dark")
    page.wait_for_timeout(300)
    assert scheme(page) == "light"  # as was chosen by hand
    page.reload(wait_until="commit")
    expect(page.locator("#tofscope-opening")).to_have_css("background-color", "rgb(246, 247, 250)")
    until(page, panel(page).is_visible)
    assert scheme(page) == "light"


@pytest.fixture
def crowded(tmp_path: Path, recordings_folder: Path, estimates: Estimates) -> Iterator[Server]:
    """A sample, and 2,000 files that are none, in folders."""
    sample = next(recordings_folder.glob("towards*"))
    (tmp_path / sample.name).write_bytes(sample.read_bytes())
    for day in range(20):
        folder = tmp_path / f"day_{day:02}"
        folder.mkdir()
        for k in range(100):
            (folder / f"run_{k:03}.mcap").touch()
    shared = Shared(Library([tmp_path], open_recording), estimates, Reloads(), Parameters())
    server = Server(shared, "127.0.0.1", 0)
    yield server
    server.close()


def test_two_thousand_are_searched_and_scrolled(crowded: Server, context: BrowserContext):
    tab = Tab(context, crowded.address)
    tab.page.locator("canvas[data-engine]").click()
    tab.page.keyboard.press("o")
    rows = tab.page.locator("#tofscope-recordings [role=option]:visible")
    expect(rows).to_have_count(2001)
    tab.page.keyboard.type("day_19 run_09")
    expect(rows).to_have_count(10)
    # What is seen is looked at first.
    expect(rows.first).to_have_class(re.compile("unreadable"), timeout=20_000)
    tab.page.keyboard.press("End")
    for _ in range(3):
        tab.page.keyboard.press("ArrowDown")
    assert tab.page.locator(".tofscope-row.active").inner_text().startswith("day_19/run_093")
