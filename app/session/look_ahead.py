"""Estimates of the frames that playback comes to next, while the one before is drawn."""

from concurrent.futures import Future, ThreadPoolExecutor, wait

from app.analysis.estimates import Estimates
from app.analysis.library import Opened
from app.session.clock import PlaybackClock
from estimator import Parameters

_FRAMES = 2  # at a time, each on a core: the compiled engine works without the interpreter's lock
_SLOWEST = 0.5  # seconds; drawings further apart had a pause between them


class LookAhead:
    """Estimates frames before they are due; used by the session's thread alone.

    Args:
        estimates: computes and caches flows.
    """

    def __init__(self, estimates: Estimates) -> None:
        self._estimates = estimates
        self._pool = ThreadPoolExecutor(_FRAMES, thread_name_prefix="look-ahead")
        self._running: dict[tuple[int, int, Parameters], Future[None]] = {}
        self._last = 0.0

    def follow(
        self, opened: Opened, clock: PlaybackClock, now: float, parameters: Parameters
    ) -> None:
        """Begin to estimate what comes after the frame that is drawn now, as far as there is room.

        Args:
            opened: must stay open until `stop`.
            clock: that plays it.
            now: seconds of a monotonic clock.
            parameters: of the estimates.
        """
        taken, self._last = now - self._last, now
        coming = clock.coming(now, taken if taken < _SLOWEST else 0.0, _FRAMES)
        self._running = {key: f for key, f in self._running.items() if not f.done()}
        for frame in coming:
            key = (opened.number, frame, parameters)
            known = self._estimates.known(opened, frame, parameters) is not None
            if not known and key not in self._running and len(self._running) < _FRAMES:
                self._running[key] = self._pool.submit(self._estimate, opened, frame, parameters)

    def stop(self) -> None:
        """Wait for what is running."""
        wait(self._running.values())

    def close(self) -> None:
        """Stop, and end the threads."""
        self._pool.shutdown()

    def _estimate(self, opened: Opened, frame: int, parameters: Parameters) -> None:
        try:
            self._estimates.estimated(opened, frame, parameters)
        except Exception:
            return
