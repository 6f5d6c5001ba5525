"""How much a page loads until its first frame is drawn."""

from typing import Any

from playwright.sync_api import BrowserContext, WebSocket

from app.server.server import Server
from tests.browser.tab import until

_MOST = 3_000_000  # bytes


def test_a_page_loads_less_than_three_megabytes(context: BrowserContext, server: Server):
    page = context.new_page()
    loaded = {"files": 0, "messages": 0}

    def count_file(event: dict[str, Any]) -> None:
        loaded["files"] += int(event["encodedDataLength"])

    def count_message(data: str | bytes) -> None:
        loaded["messages"] += len(data)

    def follow(socket: WebSocket) -> None:
        socket.on("framereceived", count_message)

    network = context.new_cdp_session(page)
    network.send("Network.enable")
    network.send("Network.setCacheDisabled", {"cacheDisabled": True})
    network.on("Network.loadingFinished", count_file)
    page.on("websocket", follow)
    page.goto(server.address)
    page.wait_for_selector("canvas[data-engine]", state="attached")
    until(page, lambda: page.locator("#tofscope-timeline[data-frame]").count() > 0)
    page.wait_for_timeout(3000)  # in which plots and images of sensors come
    assert loaded["files"] > 300_000
    assert loaded["messages"] > 300_000
    assert sum(loaded.values()) < _MOST, loaded
