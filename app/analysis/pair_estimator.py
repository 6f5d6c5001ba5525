"""Flow of any pair of a recording, by pure methods and by trackers."""

import threading
import time
from collections import OrderedDict
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace

from app.analysis.pairs import Pair, PreparedPair, prepare_pair
from estimator import Parameters, SceneFlow, Tracker, estimate, find_method
from recordings import Recording

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
        """
        prepared = prepare(k)
        if prepared.window is None:
            return prepared.pair
        if self._method.tracker is not None:
            flow, seconds = self._segment(k, self._method.tracker).at(k, prepare)
        else:
            start = time.perf_counter()
            flow = estimate(prepared.window, self._parameters)
            seconds = time.perf_counter() - start
        return replace(prepared.pair, flow=flow, milliseconds=1e3 * seconds)

    def _segment(self, k: int, tracker: Callable[[Parameters], Tracker]) -> "_Segment":
        n = self._parameters.n
        index = (k - n) // SEGMENT
        with self._lock:
            if index not in self._segments:
                first = max(n, n + index * SEGMENT - self._method.warm_up)
                self._segments[index] = _Segment(tracker(self._parameters), first)
            self._segments.move_to_end(index)
            while len(self._segments) > _KEPT_SEGMENTS:
                self._segments.popitem(last=False)
            return self._segments[index]


@dataclass
class _Segment:
    """Results of a tracker over a segment, computed up to the last requested frame."""

    tracker: Tracker
    next: int
    found: dict[int, tuple[SceneFlow, float] | Exception] = field(default_factory=dict)
    lock: threading.Lock = field(default_factory=threading.Lock)

    def at(self, k: int, prepare: Prepare) -> tuple[SceneFlow, float]:
        """Flow of frame `k` and the seconds of its step; an error of the step is raised again."""
        with self.lock:
            while self.next <= k:
                self.found[self.next] = self._step(self.next, prepare)
                self.next += 1
            found = self.found[k]
        if isinstance(found, Exception):
            raise found
        return found

    def _step(self, k: int, prepare: Prepare) -> tuple[SceneFlow, float] | Exception:
        # Errors are kept per frame: a broken frame does not end the segment.
        try:
            window = prepare(k).window
            assert window is not None
            start = time.perf_counter()
            flow = self.tracker.step(window)
            return flow, time.perf_counter() - start
        except Exception as error:
            return error


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
