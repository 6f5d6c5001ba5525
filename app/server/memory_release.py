"""Return of memory to the system after clients have disconnected."""

import ctypes
import gc
import threading

_ARENA_MAX = -8  # M_ARENA_MAX of malloc.h
_QUIET = 2.0  # seconds after the last disconnect, so that several cause one collection


class MemoryRelease:
    """Delayed garbage collection that returns freed memory to the system.

    Many threads buffer messages to clients, megabytes each. The C library keeps freed buffers
    unless told to return them.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._timer: threading.Timer | None = None

    def soon(self) -> None:
        """Schedule a collection, once no client has disconnected for a while."""
        with self._lock:
            if self._timer:
                self._timer.cancel()
            self._timer = threading.Timer(_QUIET, release)
            self._timer.daemon = True
            self._timer.start()

    def close(self) -> None:
        """Cancel a scheduled collection."""
        with self._lock:
            if self._timer:
                self._timer.cancel()


def release() -> None:
    """Collect garbage and return free memory to the system."""
    gc.collect()
    trim()


def trim() -> None:
    """Return free memory to the system, where the C library can."""
    malloc_trim = getattr(ctypes.CDLL(None), "malloc_trim", None)  # glibc alone has it
    if malloc_trim is not None:
        malloc_trim(0)


def keep_together() -> None:
    """Have all threads share two heaps, where the C library can.

    Each thread's own heap would keep what was freed in it: an hour's clouds, made by one thread
    and dropped by another, held 150 MB more.
    """
    mallopt = getattr(ctypes.CDLL(None), "mallopt", None)  # glibc alone has this option
    if mallopt is not None:
        mallopt(_ARENA_MAX, 2)
