"""Front page: what is seen until a session has something to show, and again while it opens."""

from functools import cache

import viser

from app.browser.assets import call, text_of
from app.browser.internals import PAGE_TITLE


def front_page(html: bytes, title: str) -> bytes:
    """Viser's page with our title, and with a card in place of its panel until ours is there.

    Args:
        html: viser's page.
        title: of the browser's tab.
    """
    return html.replace(PAGE_TITLE.encode(), f"<title>{title}</title>{_head()}".encode(), 1)


def show_opening(client: viser.ClientHandle, name: str) -> None:
    """Say over the scene that a recording is being opened."""
    call(client, "opening.show", name)


def end_opening(client: viser.ClientHandle) -> None:
    """Show the page, without the card."""
    call(client, "opening.end")


def show_nothing_open(client: viser.ClientHandle, sentence: str) -> None:
    """Show the page, and say over the scene that nothing is open."""
    call(client, "opening.nothing", sentence)


def keep_theme(client: viser.ClientHandle, dark: bool, chosen: bool) -> None:
    """Tell the page how it is, and let a reload begin so where a person has chosen it."""
    call(client, "opening.theme", dark, chosen)


@cache
def _head() -> str:
    return f"<style>{text_of('opening.css')}</style><script>{text_of('opening.js')}</script>"
