"""Tabs, hints and names of keys in a real Chromium."""

from tests.browser.tab import Tab


def test_tabs_stay_open_over_a_reload_and_begin_with_the_first(tab: Tab):
    def open_tabs() -> list[str]:
        return tab.page.locator("[role=tab][aria-selected=true]").all_inner_texts()

    tab.until(lambda: "Explain" in open_tabs())
    tab.show("View")
    tab.until(lambda: "View" in open_tabs())
    tab.page.reload()
    tab.until(lambda: "View" in open_tabs())
    tab.until(lambda: tab.has_text("Moving") and len(tab.arrows()) > 0)
    assert "View" in open_tabs()
    tab.page.get_by_role("tab", name="View", exact=True).press("ArrowRight")
    tab.page.get_by_role("tab", name="Export", exact=True).press("ArrowRight")
    tab.until(lambda: "More" in open_tabs() and "View" not in open_tabs())
    tab.page.reload()
    tab.until(lambda: "More" in open_tabs())
    tab.begin_again()  # as a new tab of the browser, which keeps nothing
    tab.until(lambda: "Explain" in open_tabs() and "More" not in open_tabs())


def test_labels_say_what_their_controls_say_and_keys_are_those_of_a_keyboard(tab: Tab):
    label = tab.page.locator("label", has_text="γ").first
    hint = "A cluster is classified once its ICP fitness is above this. From 0 to 1;"
    tab.until(lambda: (label.get_attribute("title") or "").startswith(hint))
    tab.show("More")  # whose labels appear only now
    label = tab.page.locator("label", has_text="min cluster size").first
    tab.until(lambda: (label.get_attribute("title") or "").startswith("Smallest cluster"))

    tab.page.locator("canvas[data-engine]").click()
    tab.page.keyboard.press("Control+k")
    search = tab.page.get_by_placeholder("Search commands")
    search.fill("frame")
    actions = tab.page.locator(".mantine-Spotlight-action")
    tab.until(lambda: actions.get_by_text("←", exact=True).count() > 0)
    tab.until(lambda: actions.get_by_text("Home", exact=True).count() > 0)
    assert "arrowleft" not in " ".join(actions.all_inner_texts()).lower()
    search.fill("play or pause")
    tab.until(lambda: actions.get_by_text("Space", exact=True).count() > 0)
    search.fill("legend")  # which holds the name of a key
    tab.until(lambda: "Legend" in " ".join(actions.all_inner_texts()))
    assert "LegEnd" not in " ".join(actions.all_inner_texts())
    tab.page.keyboard.press("Escape")
