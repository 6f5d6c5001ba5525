"""Flow of any pair of a recording, by pure methods and by trackers."""

import logging
import threading
import time
from collections import OrderedDict
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace

from app.analysis.method_files import method_files
from app.analysis.pairs import Pair, PreparedPair, prepare_pair
from app.errors import UserError
from estimator import (
    Method,
    MethodError,
    Parameters,
    SceneFlow,
    Tracker,
    Window,
    checked_flow,
    estimate,
    find_method,
)
from recordings import Recording, RecordingError

_LOG = logging.getLogger(__name__)
SEGMENT = 64
"""Frames of a segment. A tracker restarts for each segment, its warm-up before the first frame."""
_KEPT_SEGMENTS = 4

Prepare = Callable[[int], PreparedPair]


class PairEstimator:
    """Estimates pairs of one recording with one set of parameters, in any order, from any thread.

    A pair's flow does not depend on the order of calls: a pure method sees its window alone, and
    a tracker runs over fixed segments, starting `warm_up` frames before each.

    Args:
        parameters: of the estimates, method included.
    """

    def __init__(self, parameters: Parameters) -> None:
        self._parameters = parameters
        self._method = find_method(parameters.method)
        self._lock = threading.Lock()
        self._segments: OrderedDict[int, _Segment] = OrderedDict()

    def pair(self, k: int, prepare: Prepare) -> Pair:
        """The pair (k-n, k) with its flow; without one if frame k-n is before the start.

        Args:
            k: the target's frame.
            prepare: loads the pair of a frame.

        Raises:
            RecordingError: the file is broken there.
            MethodError: the method gave no flow, or is a user's own and failed.
        """
        prepared = prepare(k)
        if prepared.window is None:
            return prepared.pair
        if self._method.tracker is not None:
            timed = self._segment(k, self._method.tracker).at(k, prepare)
        else:
            timed = _timed(
                self._method, lambda window: estimate(window, self._parameters), prepared.window
            )
        return replace(
            prepared.pair,
            flow=timed.flow,
            milliseconds=1e3 * timed.seconds,
            reused=timed.reused,
        )

    def _segment(self, k: int, tracker: Callable[[Parameters], Tracker]) -> "_Segment":
        n = self._parameters.n
        index = (k - n) // SEGMENT
        with self._lock:
            if index not in self._segments:
                first = max(n, n + index * SEGMENT - self._method.warm_up)
                self._segments[index] = _Segment(self._method, tracker(self._parameters), first)
            self._segments.move_to_end(index)
            while len(self._segments) > _KEPT_SEGMENTS:
                self._segments.popitem(last=False)
            return self._segments[index]


@dataclass(frozen=True)
class _Timed:
    """A flow, the seconds that it took, and whether parts of it had been computed before."""

    flow: SceneFlow
    seconds: float
    reused: bool


@dataclass
class _Segment:
    """Results of a tracker over a segment, computed up to the last requested frame."""

    method: Method
    tracker: Tracker
    next: int
    found: dict[int, _Timed | Exception] = field(default_factory=dict)
    lock: threading.Lock = field(default_factory=threading.Lock)

    def at(self, k: int, prepare: Prepare) -> _Timed:
        """Flow of frame `k`, with the seconds of its step; an error of the step is raised again."""
        with self.lock:
            while self.next <= k:
                self.found[self.next] = self._step(self.next, prepare)
                self.next += 1
            found = self.found[k]
        if isinstance(found, Exception):
            raise found.with_traceback(None)  # or it grows each time
        return found

    def _step(self, k: int, prepare: Prepare) -> _Timed | Exception:
        # A frame that is broken in the file, or fails the method, does not end the segment. Another
        # error of reading is raised before the step, which the next request makes again.
        try:
            window = prepare(k).window
        except RecordingError as error:
            return error.with_traceback(None)
        assert window is not None
        try:
            return _timed(self.method, self.tracker.step, window)
        except Exception as error:
            return error.with_traceback(None)


def _timed(method: Method, step: Callable[[Window], SceneFlow], window: Window) -> _Timed:
    """Flow of a window and the seconds that it took.

    Raises:
        MethodError: the method gave no flow of the window's source, or is a user's own and failed.
    """
    start, reused = time.perf_counter(), window.stages.reused
    try:
        flow = step(window)
    except UserError:
        raise
    except Exception as error:
        if not method_files([method.name]):
            raise
        _LOG.debug("Method %s failed.", method.name, exc_info=True)
        raise MethodError(
            f"Method {method.name} failed ({type(error).__name__}: {error}); --log-level debug "
            "shows where."
        ) from error
    seconds = time.perf_counter() - start
    return _Timed(checked_flow(method, window, flow), seconds, window.stages.reused > reused)


def flows(recording: Recording, parameters: Parameters) -> Iterator[tuple[int, SceneFlow]]:
    """Estimate every pair (k-n, k) of a recording in order, with the same results as the page.

    Args:
        recording: to estimate.
        parameters: of the estimates, method included.

    Yields:
        k and the flow of the source points.

    Raises:
        RecordingError: the file is broken at a frame.
    """
    estimator = PairEstimator(parameters)
    for k in range(parameters.n, len(recording)):
        flow = estimator.pair(k, lambda k: prepare_pair(recording, k, parameters)).flow
        assert flow is not None
        yield k, flow
