"""Headless Chromium, which renders scenes for exports."""

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from pathlib import Path

from app.errors import InputError
from app.exports.devtools import DevTools, DevToolsError
from app.output.scratch import scratch_folder

_NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
_TIMEOUT = 60.0  # seconds until Chromium must have started, on a busy machine
_ENDING = 1.0  # seconds from the end of its pipe to that of the process
_LONGEST = 30
"""Bytes of a path in which Chromium can make sockets, whose paths have 104: else it aborts."""
_FLAGS = (
    "--headless",
    # It ends when the pipe is closed, which happens however this process ends.
    "--remote-debugging-pipe",
    "--no-startup-window",
    "--no-first-run",
    "--no-default-browser-check",
    # In containers and on some distributions there is no sandbox; the only page is our own.
    "--no-sandbox",
    "--disable-dev-shm-usage",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-extensions",
    "--disable-breakpad",
    "--disable-crash-reporter",
    "--password-store=basic",
    "--use-mock-keychain",
    "--hide-scrollbars",
    "--mute-audio",
    "--force-color-profile=srgb",
    "--disable-background-timer-throttling",
    "--disable-backgrounding-occluded-windows",
    "--disable-renderer-backgrounding",
    "--ignore-gpu-blocklist",
    # Software rendering gives the same picture on every machine.
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
)


_LAUNCH = """
import fcntl, os, sys
# High first: either of them may be 3 or 4 already.
pipes = [fcntl.fcntl(int(number), fcntl.F_DUPFD, 10) for number in sys.argv[1:3]]
for number, pipe in zip((3, 4), pipes):
    os.dup2(pipe, number)
    os.close(pipe)
os.execv(sys.argv[3], sys.argv[3:])
"""
"""Program that becomes Chromium, which wants the pipe's ends under the numbers 3 and 4."""


@contextmanager
def headless_page(address: str, width: int, height: int) -> Iterator[None]:
    """Context with a page open in a headless window of this size in pixels.

    No process and no temporary file is left at its end.

    Raises:
        InputError: Chromium is missing or does not start.
    """
    path = _find()
    with scratch_folder(_place()) as folder, _started(path, folder) as devtools:
        _open(devtools, address, width, height)
        yield


def _place() -> Path:
    """Folder for Chromium's own: the system's for temporary files, or /tmp where it is too long."""
    usual = Path(tempfile.gettempdir())
    return usual if len(os.fsencode(usual)) <= _LONGEST else Path("/tmp")


@contextmanager
def _started(path: str, folder: Path) -> Iterator[DevTools]:
    """Context of a running Chromium, all of whose files are in a folder."""
    (its_input, ours), (theirs, its_output) = os.pipe(), os.pipe()
    command = [sys.executable, "-IS", "-c", _LAUNCH, str(its_input), str(its_output), path]

    def start() -> subprocess.Popen[bytes]:
        try:
            return subprocess.Popen(
                [*command, *_FLAGS, f"--user-data-dir={folder / 'profile'}"],
                env=os.environ | {"TMPDIR": str(folder), "XDG_CONFIG_HOME": str(folder)},
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                pass_fds=(its_input, its_output),
                # Ctrl-C in a terminal reaches only us, and we end it.
                start_new_session=True,
            )
        finally:
            os.close(its_input)
            os.close(its_output)

    # Ctrl-C interrupts the main thread: what another one starts is not lost to it.
    with DevTools(ours, theirs) as devtools, ThreadPoolExecutor(1) as thread:
        starting = thread.submit(start)
        try:
            process = starting.result()
            try:
                yield devtools
            except DevToolsError as error:
                reason = str(error)
                with suppress(subprocess.TimeoutExpired):
                    reason += f", with the exit code {process.wait(_ENDING)}"
                raise InputError(f"Chromium at {path} does not start ({reason}).") from error
        finally:
            process = starting.result()
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()


def _open(devtools: DevTools, address: str, width: int, height: int) -> None:
    """Open a page."""
    end = time.monotonic() + _TIMEOUT
    target = devtools.ask("Target.createTarget", end, url="about:blank")["targetId"]
    asked = {"targetId": target, "flatten": True}
    session = devtools.ask("Target.attachToTarget", end, **asked)["sessionId"]
    size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
    devtools.ask("Emulation.setDeviceMetricsOverride", end, session, **size)
    devtools.ask("Page.navigate", end, session, url=address)


def _find() -> str:
    """Path of Chromium: the system's, else the one installed by playwright."""
    for name in _NAMES:
        if path := shutil.which(name):
            return path
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        own = playwright.chromium.executable_path
    if Path(own).exists() and os.access(own, os.X_OK):
        return own
    raise InputError(
        "Pictures are drawn by Chromium, and there is none on the PATH; install it with "
        "'sudo apt-get install chromium' or with 'playwright install chromium'."
    )
