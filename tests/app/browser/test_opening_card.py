"""The page as it is sent: ours from the first picture on."""

import gzip
import http.client

import pytest

from app.browser import internals
from app.browser.assets import text_of
from app.browser.guarded_server import GuardedServer
from app.browser.opening_card import front_page
from tests.app.browser.viser_page import page


def test_the_page_begins_with_our_card_before_all_that_is_loaded():
    html = front_page(page().encode(), "Tofscope").decode()
    assert "<title>Tofscope</title>" in html
    assert internals.PAGE_TITLE not in html
    card, loaded = html.index("tofscope-opening"), html.index("data-p=")
    assert card < loaded, "the card waits for viser's script, which is large"
    assert len(html) < len(page()) + 12_000


@pytest.fixture
def server():
    server = GuardedServer("127.0.0.1", 0, page=lambda html: front_page(html, "Tofscope"))
    yield server
    server.stop()


@pytest.mark.parametrize("encoding", ["gzip", "identity"])
def test_it_is_sent_whole_however_it_is_asked_for(server, encoding):
    for _ in range(2):  # the second from what was kept
        connection = http.client.HTTPConnection("127.0.0.1", server.get_port(), timeout=10)
        connection.request("GET", "/?link=abc", headers={"Accept-Encoding": encoding})
        answer = connection.getresponse()
        body = answer.read()
        connection.close()
        assert answer.getheader("Content-Length") == str(len(body))
        assert answer.getheader("Content-Encoding") == encoding
        assert answer.headers.get_all("Content-Length") == [str(len(body))]
        assert len(body) < 1_500_000
        html = gzip.decompress(body) if encoding == "gzip" else body
        assert html == front_page(page().encode(), "Tofscope")


def test_scripts_and_styles_name_what_viser_names():
    style, script = text_of("opening.css"), text_of("opening.js")
    assert f"tofscope-starting {internals.PAGE_ROOT} " in style
    assert f"button:has({internals.SETTINGS_ICON})" in style
    for news in internals.CONNECTION_NEWS:
        assert f'"{news}"' in script
