"""A real Chromium looking at the app."""

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, BrowserContext, sync_playwright

from app.analysis.estimates import Estimates, warm_up
from app.analysis.library import Library
from app.server.server import Server
from app.server.session import Shared
from app.session.reload import Reloads
from estimator import Parameters
from recordings import open_recording, sample_paths
from tests.browser.tab import Tab

_NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
FLAGS = [
    "--headless=new",
    "--no-sandbox",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--use-angle=swiftshader",
    "--disable-gpu-compositing",  # the page itself is drawn faster without SwiftShader
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
]
# What a test asks is in the scene tree; drawing it in software would only take time.
NO_DRAWING = """
for (const context of [WebGLRenderingContext, WebGL2RenderingContext])
  for (const name of ["drawArrays", "drawElements", "drawArraysInstanced", "drawElementsInstanced",
                      "drawRangeElements"])
    if (context.prototype[name]) context.prototype[name] = () => {};
"""


@pytest.fixture(scope="package")
def chromium() -> Iterator[Browser]:
    path = next(filter(None, map(shutil.which, _NAMES)), None)
    if path is None:
        pytest.fail("There is no Chromium; install it: sudo apt-get install chromium")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=FLAGS)
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def recordings_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The samples and a file that is no recording."""
    folder = tmp_path_factory.mktemp("recordings")
    for path in sample_paths():
        shutil.copy(path, folder)
    assert list(folder.glob("*robot_moving*")), "the samples are missing: make samples"
    (folder / "zz_bad.mcap").write_bytes(b"this is no recording")
    return folder


@pytest.fixture(scope="session")
def estimates() -> Estimates:
    """Cache of estimates, shared by all tests."""
    warm_up()  # so that no test's page waits for it
    return Estimates()


@pytest.fixture(scope="package")
def server(recordings_folder: Path, estimates: Estimates) -> Iterator[Server]:
    library = Library([recordings_folder], open_recording)
    server = Server(Shared(library, estimates, Reloads(), Parameters()), "127.0.0.1", 0)
    yield server
    server.close()


@pytest.fixture(autouse=True)
def _own_configuration(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Presets are those of the test."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))


@pytest.fixture(scope="package")
def window(chromium: Browser) -> BrowserContext:
    context = chromium.new_context(accept_downloads=True)
    context.set_default_timeout(30_000)
    context.add_init_script(NO_DRAWING)
    return context


@pytest.fixture(scope="package")
def first_tab(window: BrowserContext, server: Server) -> Tab:
    return Tab(window, server.address)


@pytest.fixture
def tab(first_tab: Tab) -> Tab:
    """A new session, in a page that is loaded once since that takes seconds."""
    first_tab.begin_again()
    return first_tab


@pytest.fixture
def wide_tab(first_tab: Tab) -> Iterator[Tab]:
    """The same in a window that is wide enough for the panel on the left to be open."""
    with first_tab.widened() as wide:
        yield wide


@pytest.fixture
def context(window: BrowserContext) -> Iterator[BrowserContext]:
    """A window for further tabs, which are closed in the end."""
    before = list(window.pages)
    yield window
    for page in window.pages:
        if page not in before:
            page.close()
