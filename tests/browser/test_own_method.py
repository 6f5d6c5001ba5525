"""A method of a user's own on the page: chosen, tuned with its own slider, explained."""

import pytest
from playwright.sync_api import BrowserContext

from app.server.server import Server
from estimator import register
from tests.browser.tab import Tab
from tests.own_methods import CENTROID, RANGE_RATE


@pytest.fixture
def tab(methods_of_a_test, context: BrowserContext, server: Server) -> Tab:
    register(RANGE_RATE)
    register(CENTROID)
    return Tab(context, server.address)


def choose_method(tab: Tab, name: str) -> None:
    tab.row("method").locator("input").first.click()
    tab.page.get_by_role("option", name=name).click()


def test_its_slider_changes_its_flow_and_the_papers_are_gone(tab: Tab):
    by_paper = len(tab.arrows())
    assert tab.page.get_by_text("v_0", exact=True).count() == 0
    choose_method(tab, RANGE_RATE.name)
    tab.until(lambda: len(tab.arrows()) > 3 * by_paper)
    tab.until(lambda: tab.page.get_by_text("γ", exact=True).count() == 0)
    slow = len(tab.arrows())
    tab.set_slider("v_0", "End")
    tab.until(lambda: 0 < len(tab.arrows()) < 0.9 * slow)
    choose_method(tab, CENTROID.name)
    tab.until(lambda: len(tab.arrows()) > slow)
    choose_method(tab, "paper")
    tab.until(lambda: len(tab.arrows()) == by_paper)
    tab.until(lambda: tab.value("γ") == 0.7)
