"""Signals that end a command: Ctrl-C and SIGTERM."""

import os
import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

STOPPED = 130
"""Exit code of a command that a signal ends."""

_ENDING = (signal.SIGINT, signal.SIGTERM)
_Handler = Callable[[int, FrameType | None], object] | signal.Handlers


@contextmanager
def ending_at_once() -> Iterator[None]:
    """Context in which a signal ends the process, for imports: nothing is begun that could be lost.

    KeyboardInterrupt would be swallowed by some modules that are being imported, and leave others
    half imported.
    """
    with handled(lambda *_: os._exit(STOPPED)):
        yield


@contextmanager
def raising_keyboard_interrupt() -> Iterator[None]:
    """Context in which SIGTERM raises KeyboardInterrupt, as Ctrl-C does: work is cleaned up."""

    def stop(*_: object) -> None:
        for number in _ENDING:
            signal.signal(number, signal.SIG_IGN)  # a second one must not interrupt the cleanup
        raise KeyboardInterrupt

    with handled(stop):
        yield


@contextmanager
def handled(handler: _Handler) -> Iterator[None]:
    """Context in which a handler gets the signals; without effect outside the main thread."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = {number: signal.signal(number, handler) for number in _ENDING}
    try:
        yield
    finally:
        for number, former in before.items():
            signal.signal(number, former)


def ignore() -> None:
    """Ignore signals from now on, while the interpreter ends."""
    for number in _ENDING:
        signal.signal(number, signal.SIG_IGN)
