"""Waiting for what happens in other threads."""

import time
from collections.abc import Callable
from typing import Any


def until(condition: Callable[[], Any], timeout: float = 60.0) -> None:
    """Wait until something holds; a busy machine may take its time over it."""
    end = time.monotonic() + timeout
    while not condition():
        assert time.monotonic() < end, "it did not come true in time"
        time.sleep(0.01)
