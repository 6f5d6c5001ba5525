"""Estimates of the frames that playback comes to next, while the one before is drawn."""

from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait

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
        self._begun: dict[tuple[int, int, Parameters], Future[None]] = {}
        self._last = 0.0

    def frame_to_draw(self, opened: Opened, due: int, drawn: int, parameters: Parameters) -> int:
        """The frame that is due or, where its estimate was not begun, the next that will be ready.

        Where estimates take longer than frames, those that were begun in time are drawn, so that
        none is in vain.

        Args:
            opened: the recording.
            due: the frame that is due.
            drawn: the frame that is drawn.
            parameters: of the estimates.
        """
        if self._estimates.known(opened, due, parameters) is not None:
            return due
        begun = {
            frame: future
            for (number, frame, others), future in self._begun.items()
            if (number, others) == (opened.number, parameters) and drawn < frame <= due
        }
        if not begun or due in begun:
            return due
        wait(begun.values(), return_when=FIRST_COMPLETED)
        return max(frame for frame, future in begun.items() if future.done())

    def follow(
        self, opened: Opened, clock: PlaybackClock, now: float, drawn: int, parameters: Parameters
    ) -> None:
        """Begin to estimate what comes after the frame that is drawn now, as far as there is room.

        Args:
            opened: must stay open until `stop`.
            clock: that plays it.
            now: seconds of a monotonic clock.
            drawn: the frame that is drawn now.
            parameters: of the estimates.
        """
        taken, self._last = now - self._last, now
        coming = clock.coming(now, taken if taken < _SLOWEST else 0.0, _FRAMES)
        self._begun = {
            key: future
            for key, future in self._begun.items()
            if not future.done() or (key[0] == opened.number and key[1] > drawn)
        }
        for frame in coming:
            key = (opened.number, frame, parameters)
            running = sum(not future.done() for future in self._begun.values())
            known = self._estimates.known(opened, frame, parameters) is not None
            if not known and key not in self._begun and running < _FRAMES:
                self._begun[key] = self._pool.submit(self._estimate, opened, frame, parameters)

    def stop(self) -> None:
        """Wait for what is running."""
        wait(self._begun.values())

    def close(self) -> None:
        """Stop, and end the threads."""
        self._pool.shutdown()

    def _estimate(self, opened: Opened, frame: int, parameters: Parameters) -> None:
        try:
            self._estimates.estimated(opened, frame, parameters)
        except Exception:
            return
