"""Latency of δ in a real browser: from a move of the mouse to new arrows in the page.

Run it from the project's folder: `.venv/bin/python -m benchmarks.page`. With `--against FOLDER`,
another checkout of the project is measured in the same run, in turns with this one.
"""

import argparse
import contextlib
import shutil
import statistics
from pathlib import Path

from playwright.sync_api import Browser, Page, TimeoutError, sync_playwright

from benchmarks.serving import machine, serving
from tests.browser.conftest import FLAGS, NO_DRAWING

_ROUNDS = 4
_MOVES = 10  # of the mouse, in each round
_LOW, _HIGH = 0.12, 0.36  # shares of the slider's track; other arrows are drawn at either
_FREE = 0.005  # share of the track from one move to the next, so that no result is used twice
_TIMEOUT = 5_000  # milliseconds

# A move counts from the event to the next animation frame at which the arrows are new.
_WATCH = """() => {
  const arrows = () => window.__viserSceneTree.getState()["/fixed/flow"]?.message.props;
  let drawn = arrows()?.points, moved = 0;
  window.latencies = [];
  addEventListener("pointermove", () => { moved = performance.now(); }, true);
  const look = () => {
    const points = arrows()?.points;
    if (points !== drawn && moved) {
      window.latencies.push(performance.now() - moved);
      moved = 0;
    }
    drawn = points;
    requestAnimationFrame(look);
  };
  look();
}"""


class _Hand:
    """A page whose δ is dragged by the mouse."""

    def __init__(self, browser: Browser, address: str, *, draw: bool) -> None:
        context = browser.new_context(viewport={"width": 1600, "height": 900})
        if not draw:
            context.add_init_script(NO_DRAWING)
        self._page: Page = context.new_page()
        self._page.goto(address)
        self._page.wait_for_function("() => document.body.innerText.includes('Moving')")
        self._page.wait_for_timeout(8_000)  # until the plots are filled
        self._page.evaluate(_WATCH)
        row = self._page.get_by_text("δ", exact=False).locator(
            "xpath=ancestor::*[.//*[@role='slider']][1]"
        )
        track = row.first.locator(".mantine-Slider-track").bounding_box()
        assert track is not None, "δ is not in sight"
        self._left, self._width = track["x"], track["width"]
        self._height = track["y"] + track["height"] / 2
        self._moves = 0

    def drag(self) -> list[float]:
        """Milliseconds of each move of one drag."""
        mouse = self._page.mouse
        mouse.move(self._left + self._width / 4, self._height)
        mouse.down()
        self._page.wait_for_timeout(1_000)
        self._page.evaluate("window.latencies.length = 0")
        for count in range(1, _MOVES + 1):
            self._moves += 1
            share = (_LOW, _HIGH)[count % 2] + _FREE * (self._moves // 2)
            mouse.move(self._left + self._width * share, self._height)
            with contextlib.suppress(TimeoutError):  # no other arrows are no latency
                self._page.wait_for_function(f"latencies.length >= {count}", timeout=_TIMEOUT)
            self._page.wait_for_timeout(250)
        mouse.up()
        return self._page.evaluate("window.latencies")


def _measure(browser: Browser, folders: list[Path], *, draw: bool) -> list[list[float]]:
    with contextlib.ExitStack() as stack:
        servers = [stack.enter_context(serving(folder=folder)) for folder in folders]
        hands = [_Hand(browser, served.address, draw=draw) for served in servers]
        found: list[list[float]] = [[] for _ in hands]
        for _ in range(_ROUNDS):
            for times, hand in zip(found, hands, strict=True):
                times.extend(hand.drag())
        return found


def main() -> None:
    """Print the latencies of each checkout, with and without drawing in software."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--against", type=Path, help="folder of another checkout")
    against = parser.parse_args().against
    folders = [Path.cwd(), *([against] if against else [])]
    chromium = shutil.which("chromium") or shutil.which("google-chrome")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=FLAGS)
        for draw in (False, True):
            print(f"{'drawn in software' if draw else 'without drawing'} ({machine()})", flush=True)
            for folder, times in zip(folders, _measure(browser, folders, draw=draw), strict=True):
                print(
                    f"  {folder.name:12} {len(times):3} moves, median "
                    f"{statistics.median(times):4.0f} ms, 90 % below "
                    f"{statistics.quantiles(times, n=10)[-1]:4.0f} ms",
                    flush=True,
                )
        browser.close()


if __name__ == "__main__":
    main()
