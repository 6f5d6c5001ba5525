from tests.browser.tab import Tab


def test_a_key_switches_between_a_and_b_and_both_are_drawn_in_two_colours(tab: Tab):
    count = len(tab.arrows())
    tab.show("Compare")
    tab.page.get_by_role("button", name="Copy A to B").click()
    tab.until(lambda: tab.has_text("Switch to A") and tab.has_text("Parameters of B"))
    tab.set_slider("δ", "End")
    tab.until(lambda: len(tab.arrows()) == 0)
    tab.page.locator("canvas[data-engine]").click(position={"x": 5, "y": 5})
    tab.page.keyboard.press("b")
    tab.until(lambda: len(tab.arrows()) == count and tab.value("δ") == 0.04)
    tab.until(lambda: tab.has_text("From A to B: δ: 0.04 → 0.5"))
    tab.page.keyboard.press("b")
    tab.until(lambda: tab.value("δ") == 0.5 and len(tab.arrows()) == 0)
    tab.set_slider("δ", "Home")
    tab.page.get_by_text("Draw both", exact=True).click()
    tab.until(lambda: len(tab.points("second_flow")) == 2 * count and len(tab.arrows()) > count)
    tab.page.get_by_role("button", name="Remove B").click()
    tab.until(lambda: len(tab.points("second_flow")) == 0 and len(tab.arrows()) == count)
    tab.until(lambda: not tab.has_text("Parameters of"))
