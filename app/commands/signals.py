"""Signals that end a command: Ctrl-C and SIGTERM.

It imports little, since until it is imported a signal ends in a traceback.
"""

import atexit
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from types import FrameType

STOPPED = 130
"""Exit code of a command that a signal ends."""

_ENDING = (signal.SIGINT, signal.SIGTERM)
_OURS = ("app", "estimator", "recordings", "robot_assets")
_Handler = Callable[[int, FrameType | None], object]
_came = threading.Event()


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
    """Context in which SIGTERM raises KeyboardInterrupt, as Ctrl-C does: work is cleaned up.

    Where a library catches it, as trimesh does, or makes another error of it, as Open3D does while
    it is imported, it is raised again in our own code.
    """

    def stop(_: int, frame: FrameType | None) -> None:
        for number in _ENDING:
            signal.signal(number, signal.SIG_IGN)  # a second one must not interrupt the cleanup
        # What libraries say of the interruption is of no use.
        import logging

        logging.disable()
        sys.unraisablehook = lambda _: None
        _raise_again_in(frame)
        raise KeyboardInterrupt

    with handled(stop):
        yield


def _raise_again_in(frame: FrameType | None) -> None:
    """Trace our functions below a frame, so that what a library catches reaches them too."""

    def traced(ours: FrameType, event: str, details: object) -> None:
        kind = details[0] if isinstance(details, tuple) else None
        if event != "exception" or not issubclass(kind or Exception, KeyboardInterrupt):
            raise KeyboardInterrupt
        ours.f_trace = None

    while frame is not None:
        if str(frame.f_globals.get("__name__")).partition(".")[0] in _OURS:
            frame.f_trace = traced
        frame = frame.f_back
    sys.settrace(lambda *_: None)


@contextmanager
def handled(handler: _Handler) -> Iterator[None]:
    """Context in which a handler gets the signals; without effect outside the main thread."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def noted(number: int, frame: FrameType | None) -> None:
        _came.set()
        handler(number, frame)

    before = {number: signal.signal(number, noted) for number in _ENDING}
    try:
        yield
    finally:
        for number, former in before.items():
            signal.signal(number, former)


def came() -> bool:
    """Whether a signal has ended the command."""
    return _came.is_set()


def end(code: int) -> None:
    """End a stopped process, after Python's clean-up and without that of C libraries.

    One whose import was interrupted may set another exit code in it, and one that still computes
    in a thread aborts.
    """
    atexit._run_exitfuncs()
    for stream in (sys.stdout, sys.stderr):
        with suppress(AttributeError, OSError, ValueError):  # it may be closed, or none
            stream.flush()
    os._exit(code)


def ignore() -> None:
    """Ignore signals from now on, while the interpreter ends."""
    for number in _ENDING:
        signal.signal(number, signal.SIG_IGN)
