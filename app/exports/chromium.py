"""Headless Chromium, which renders scenes for exports."""

import contextlib
import os
import shutil
from collections.abc import Iterator
from pathlib import Path

from playwright.sync_api import Error, Playwright, sync_playwright

from app.errors import InputError

_NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
_FLAGS = (
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    "--ignore-gpu-blocklist",
    # Software rendering gives the same picture on every machine.
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
)


@contextlib.contextmanager
def headless_page(address: str, width: int, height: int) -> Iterator[None]:
    """Context with a page open in a headless window of this size in pixels.

    Raises:
        InputError: Chromium is missing or does not start.
    """
    with sync_playwright() as playwright:
        path = _find(playwright)
        try:
            browser = playwright.chromium.launch(executable_path=path, args=_FLAGS)
        except Error as error:
            reason = error.message.splitlines()[0]
            raise InputError(f"Chromium at {path} does not start ({reason}).") from error
        try:
            page = browser.new_page(viewport={"width": width, "height": height})
            page.goto(address)
            yield
        finally:
            browser.close()


def _find(playwright: Playwright) -> str:
    """Path of Chromium: the system's, else the one installed by playwright."""
    for name in _NAMES:
        if path := shutil.which(name):
            return path
    own = playwright.chromium.executable_path
    if Path(own).exists() and os.access(own, os.X_OK):
        return own
    raise InputError(
        "Pictures are drawn by Chromium, and there is none on the PATH; install it with "
        "'sudo apt-get install chromium' or with 'playwright install chromium'."
    )
