"""Calls of our own scripts in a page, as the app makes them."""

import base64
import json
import re
from typing import Any

import numpy as np

_CALL = re.compile(r"window\.tofscope\.([\w.]+)\((.*)\);", re.DOTALL)


class PageCalls:
    """The last arguments of each function, `window.tofscope.<function>`, that was called."""

    def __init__(self):
        self._last: dict[str, list[Any]] = {}

    def note(self, script: str) -> None:
        """Keep the arguments of a script that is such a call."""
        if call := _CALL.fullmatch(script):
            self._last[call[1]] = json.loads(f"[{call[2]}]")

    def shown(self, function: str) -> list[Any] | None:
        """Arguments of the last call of a function, None before the first."""
        return self._last.get(function)


def unpacked(text):
    return np.frombuffer(base64.b64decode(text), "<f4")


def frames_of(text: str) -> list[int]:
    """Frames whose bits are set, in a text of the timeline."""
    bits = np.unpackbits(np.frombuffer(base64.b64decode(text), np.uint8))
    return np.flatnonzero(bits).tolist()
