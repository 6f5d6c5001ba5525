"""Scripts and style sheets of our own elements in the page, kept as files beside this module."""

import json
from base64 import b64encode
from collections.abc import Mapping
from functools import cache
from importlib.resources import files

import numpy as np
import viser
from numpy.typing import ArrayLike

from app.browser.internals import run_script

_STYLE = """
{
  const id = "tofscope-style-%s";
  const style = document.getElementById(id) ?? document.createElement("style");
  style.id = id;
  style.textContent = %s;
  document.head.append(style);
}
"""


def run_asset(client: viser.ClientHandle, name: str) -> None:
    """Run a script, or apply a style sheet, in the page; once more after a lost connection.

    Args:
        client: owner of the page.
        name: of the file, such as "timeline.js" or "timeline.css".
    """
    text = text_of(name)
    run_script(client, _STYLE % (name, json.dumps(text)) if name.endswith(".css") else text)


def call(client: viser.ClientHandle, function: str, *values: object) -> None:
    """Call a function of our scripts in the page, `window.tofscope.<function>`.

    Args:
        client: owner of the page.
        function: its name, such as "timeline.show".
        values: arguments that JSON can hold.
    """
    arguments = ", ".join(json.dumps(value, separators=(",", ":")) for value in values)
    run_script(client, f"window.tofscope.{function}({arguments});")


class ChangedCalls:
    """Calls functions of our scripts in the page, each only with another value than its last.

    Args:
        client: owner of the page.
        known: {function: value} that the page begins with.
    """

    def __init__(
        self, client: viser.ClientHandle, known: Mapping[str, object] | None = None
    ) -> None:
        self._client = client
        self._last: dict[str, object] = dict(known or {})

    def send(self, function: str, value: object) -> None:
        """Call a function with a value that JSON can hold, unless it was the last one."""
        if function not in self._last or self._last[function] != value:
            self._last[function] = value
            call(self._client, function, value)


def packed(values: ArrayLike, kind: str) -> str:
    """Values in base64 for our scripts, as a NumPy type such as "<f4" or "u1", rows first."""
    return b64encode(np.ascontiguousarray(values).astype(kind).tobytes()).decode()


@cache
def text_of(name: str) -> str:
    """Text of a file beside this module, by its name."""
    return (files("app.browser") / "assets" / name).read_text(encoding="utf-8")
