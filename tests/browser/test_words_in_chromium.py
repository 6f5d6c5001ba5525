"""Words of the page: those that read oddly are nowhere, and the field's are in their places."""

import re

from tests.browser.tab import Tab

_WORDS = """() => {
  const said = new Set();
  for (const element of document.querySelectorAll("body, body *")) {
    if (element.matches("script, style")) continue;
    for (const name of ["title", "aria-label", "placeholder"])
      if (element.hasAttribute(name)) said.add(element.getAttribute(name));
    // Values that stand beside their labels, too.
    const label = element.labels?.[0]?.innerText ?? "";
    const text = element.matches("input") ? `${label} ${element.value}` : element.innerText;
    if (text && element.childElementCount < 12) said.add(text.replace(/\\s+/g, " ").trim());
  }
  return [...said];
}"""
_ODD = (
    r"^Motion\b.*\bPrevious$|^Motion$",
    r"\bEstimate \d+(\.\d+)? ms",
    r"^Interval\b",
    r"\bTruth [\d–]",
    r"\bData (simulated|measured)",
    r"\bDispl\.|\b(cov|prec|est)\.",
    r"\bway in\b",
    r"moved by the truth$|\bghost\b",
    r"^Means, \d+ pairs",
    r"\b0\.00 −0\.70\b|\b0\.000 m −",  # of a round that pairs nothing
    r"^(View )?Robot Fit\b|^Robot, Fit$",
    r"^min samples 0$",
    r"^(?!\d+ x ).*\d mm\b",  # but metres everywhere, save for sizes on paper
    r"\bReset these\b",
    r"Of the recording's own",
    r"[Aa]rrow([Ll]eft|[Rr]ight|[Uu]p|[Dd]own)",
)
"""Regular expressions of what the page shall not say."""
_ODD_BUTTONS = {"Previous", "Next", "Robot", "Reset"}
"""Buttons that do not say of what, or from where."""
_FIELD = (
    "Compute time",
    "Δt of the pair",
    "True speed",
    "Recording simulated",
    "Displacement",
    "Coverage",
    "Precision",
    "Angle deviation",
    "no pairs",
    "True object",
    "View from",
    "Next motion",
    "min samples",
    "Removed",
)
"""What it says instead, or beside it."""


def test_no_odd_word_is_anywhere_in_the_page(wide_tab: Tab):
    tab, said, buttons = wide_tab, set[str](), set[str]()

    def listen() -> None:
        tab.page.wait_for_timeout(100)
        said.update(tab.page.evaluate(_WORDS))
        buttons.update(tab.page.locator("button").all_inner_texts())

    tab.until(lambda: tab.has_text("pairs count"))
    listen()
    rows = tab.page.locator("tr[data-sets]")
    for index in range(rows.count()):
        rows.nth(index).click()
        listen()
    tab.show("Compare")
    tab.page.get_by_role("button", name="Copy A to B").click()
    tab.until(lambda: tab.has_text("Parameters of B"))
    for name in ("Compare", "View", "Export", "More"):
        tab.show(name)
        listen()
    tab.page.get_by_role("tab", name="Sensors").or_(
        tab.page.get_by_text("Sensors", exact=True)
    ).first.click()
    tab.until(lambda: tab.page.locator(".tofscope-sensor").count() == 24)
    listen()
    tab.page.evaluate("document.activeElement.blur()")
    tab.page.keyboard.press("o")
    tab.until(lambda: tab.listed("sideways").is_visible())
    listen()
    tab.page.keyboard.press("Escape")
    tab.until(lambda: not tab.listed("sideways").is_visible())
    tab.page.evaluate("document.activeElement.blur()")
    tab.page.keyboard.press("Control+k")
    for typed in ("frame", "motion", "reset", "view", "save", "robot"):
        tab.page.get_by_placeholder("Search commands").fill(typed)
        listen()
    tab.page.keyboard.press("Escape")
    assert "Copy A to B" in buttons
    assert not buttons & _ODD_BUTTONS
    for words in _FIELD:
        assert any(words in text for text in said), words
    for odd in _ODD:
        assert not [text for text in said if re.search(odd, text)], odd
