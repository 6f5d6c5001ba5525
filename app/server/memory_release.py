"""Giving memory back to the system after clients have left."""

import ctypes
import gc
import threading

_QUIET = 2.0  # seconds after the last client left, so that many that leave together cost once


class MemoryRelease:
    """Collection of all that left clients held, for the C library to return to the system.

    Messages to a client lie in buffers of megabytes, made in many threads: freed, they stay with
    the process unless the library is asked to give them back.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._timer: threading.Timer | None = None

    def soon(self) -> None:
        """Do it once no client has left for a while."""
        with self._lock:
            if self._timer:
                self._timer.cancel()
            self._timer = threading.Timer(_QUIET, release)
            self._timer.daemon = True
            self._timer.start()

    def close(self) -> None:
        """Do it no more."""
        with self._lock:
            if self._timer:
                self._timer.cancel()


def release() -> None:
    """Collect garbage and return free memory to the system, where the C library can."""
    gc.collect()
    trim = getattr(ctypes.CDLL(None), "malloc_trim", None)  # glibc alone has it
    if trim is not None:
        trim(0)
