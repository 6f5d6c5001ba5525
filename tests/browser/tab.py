"""A page of the app, and what a person would do with it."""

import re
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray
from playwright.sync_api import BrowserContext, Locator, Page, ViewportSize

from app.scene.scene_root import FIXED

_POINTS = """name => {
  const node = window.__viserSceneTree.getState()[name];
  return node ? Array.from(node.message.props.points) : null;
}"""
_NAMES = "() => Object.keys(window.__viserSceneTree.getState())"
_POSES = """names => names.map(name => {
  const node = window.__viserMutable.nodeRefFromName[name];
  if (!node) return null;
  node.updateWorldMatrix(true, false);
  return Array.from(node.matrixWorld.elements);
})"""


_FORGET = """() => {
  sessionStorage.clear();
  document.activeElement.blur();
  delete document.getElementById("tofscope-timeline").dataset.frame;
  document.querySelectorAll("[role=alert] button").forEach(button => button.click());
}"""
_BEGUN = "sessionStorage.getItem('tofscope-session') !== null"
SIZE: ViewportSize = {"width": 900, "height": 700}
WIDE: ViewportSize = {"width": 1400, "height": 720}


def until(page: Page, condition: Callable[[], Any], timeout: float = 30.0) -> None:
    """Wait until something holds in a page, which may take a busy machine some seconds."""
    end = time.monotonic() + timeout
    while not condition():
        assert time.monotonic() < end, "it did not come true in time"
        page.wait_for_timeout(50)


class Tab:
    """One browser tab that shows the app."""

    def __init__(self, context: BrowserContext, address: str) -> None:
        self.page = context.new_page()
        self.page.set_viewport_size(SIZE)
        self.page.goto(address)
        self.page.wait_for_selector("canvas[data-engine]", state="attached")
        self._wait_for_the_first_frame()

    def begin_again(self) -> None:
        """Connect anew, as after a failure of the network, with nothing to come back to."""
        self.page.mouse.move(0, 0)
        self.page.evaluate(_FORGET)
        self.page.workers[0].evaluate("self.onmessage({data: {type: 'retry'}})")
        self.until(lambda: self.page.evaluate(_BEGUN))
        self._wait_for_the_first_frame()

    def _wait_for_the_first_frame(self) -> None:
        # The first page of all loads what the others find loaded.
        until(self.page, lambda: self.has_text("Moving") and len(self.arrows()) > 0, timeout=30.0)
        self.until(lambda: self.value("Frame") == self.drawn_frame())
        self.page.wait_for_selector("#tofscope-opening", state="hidden")

    def until(self, condition: Callable[[], Any]) -> None:
        until(self.page, condition)

    def has_text(self, text: str) -> bool:
        return self.page.get_by_text(text).count() > 0

    def points(self, node: str) -> NDArray[np.float64]:
        values = self.page.evaluate(_POINTS, f"{FIXED}/{node}")
        return np.array(values or [], dtype=float).reshape(-1, 3)

    def arrows(self) -> NDArray[np.float64]:
        return self.points("flow").reshape(-1, 2, 3)

    def frustums(self) -> list[str]:
        """Names of the sensors that have a frustum."""
        root = f"{FIXED}/frustums/"
        types = "() => Object.entries(window.__viserSceneTree.getState()).filter("
        types += "([_, node]) => node.message.type === 'CameraFrustumMessage').map(([n]) => n)"
        return sorted(n.removeprefix(root) for n in self.page.evaluate(types) if n.startswith(root))

    def node(self, below: str, name: str) -> str:
        """The node of a robot's link, or of a sensor, below a node of the fixed frame."""
        root = f"{FIXED}/{below}/"
        found = self.page.evaluate(_NAMES)
        [node] = [n for n in found if n.startswith(root) and n.endswith(f"_{name}")]
        return node.removeprefix(f"{FIXED}/")

    def poses(self, names: list[str]) -> NDArray[np.float64]:
        """World poses (N, 4, 4) of nodes below the fixed frame, as the browser draws them."""
        values = self.page.evaluate(_POSES, [f"{FIXED}/{name}" for name in names])
        assert None not in values, f"not all of {names} are in the scene"
        return np.array(values).reshape(-1, 4, 4).transpose(0, 2, 1)

    def row(self, label: str) -> Locator:
        """The row of the panel that holds a control."""
        text = self.page.get_by_text(label, exact=True).first
        return text.locator("xpath=ancestor::*[.//input or .//*[@role='slider']][1]")

    def show(self, name: str) -> None:
        """Bring a tab of the panels to the front."""
        self.page.get_by_role("tab", name=name, exact=True).click()

    def slider(self, label: str) -> Locator:
        """A slider of the panel, or the timeline, whose label is Frame."""
        if label == "Frame":
            return self.page.get_by_role("slider", name=label, exact=True)
        return self.row(label).locator("[role=slider]")

    @contextmanager
    def widened(self) -> Iterator[Self]:
        """Context of a new session in a window that has room for the panel on the left."""
        self.page.set_viewport_size(WIDE)
        self.begin_again()
        yield self
        self.page.set_viewport_size(SIZE)

    def set_slider(self, label: str, key: str, times: int = 1) -> None:
        """Move a slider with the keyboard."""
        slider = self.slider(label)
        slider.focus()
        for _ in range(times):
            slider.press(key)

    def value(self, label: str) -> float:
        return float(self.slider(label).get_attribute("aria-valuenow") or "nan")

    def last_frame(self) -> int:
        """The last frame of the recording, by the timeline."""
        return int(self.slider("Frame").get_attribute("aria-valuemax") or 0)

    def drawn_frame(self) -> int:
        """The frame that the session has drawn last; a person may be ahead of it."""
        return int(self.page.locator("#tofscope-timeline").get_attribute("data-frame") or -1)

    def is_at(self, frame: int) -> bool:
        """Whether the timeline is at a frame, and the session has drawn it."""
        return self.value("Frame") == self.drawn_frame() == frame

    def open(self, scenario: str) -> None:
        """Choose a sample and wait until its first frame is shown."""
        self.choose(scenario)
        # Told after the timeline: until then it may be at a frame of the recording before.
        corner = self.page.locator("#tofscope-corner")
        self.until(lambda: f"{scenario}_" in corner.inner_text())
        self.until(self._at_rest)

    def _at_rest(self) -> bool:
        """Whether timeline and session are at the same frame, and stay there."""
        frame = self.value("Frame")
        self.page.wait_for_timeout(300)
        return self.is_at(int(frame))

    def choose(self, recording: str) -> None:
        """Choose a recording from the list by a part of its name."""
        self.page.get_by_role("button", name=re.compile("^Recording: ")).click()
        self.listed(recording).click()

    def listed(self, recording: str) -> Locator:
        """Rows of the list whose text holds this."""
        return self.page.locator("#tofscope-recordings [role=option]").filter(has_text=recording)

    def choose_option(self, label: str, option: str) -> None:
        """Choose an option of a dropdown of the panel."""
        self.row(label).locator("input").first.click()
        # Native lists of the timeline have options, too, which are in no listbox.
        self.page.get_by_role("listbox").get_by_role("option", name=option).click()
