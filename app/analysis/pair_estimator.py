"""Flow of every pair of a recording, whatever the method: pure ones and trackers."""

import threading
import time
from collections import OrderedDict
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace

from app.analysis.pairs import Pair, PreparedPair, prepare_pair
from estimator import Parameters, SceneFlow, Tracker, estimate, find_method
from recordings import Recording

SEGMENT = 64
"""Frames of a segment; a tracker begins anew for each, its warm-up before it."""
_KEPT_SEGMENTS = 4

Prepare = Callable[[int], PreparedPair]


class PairEstimator:
    """Estimates pairs of one recording with one set of parameters, in any order, from any thread.

    A pair's flow is the same whatever was asked for before it: a pure method sees its window
    alone, and a tracker is run over fixed segments, each begun its warm-up early.

    Args:
        parameters: of the estimates, method included.
    """

    def __init__(self, parameters: Parameters) -> None:
        self._parameters = parameters
        self._method = find_method(parameters.method)
        self._lock = threading.Lock()
        self._segments: OrderedDict[int, _Segment] = OrderedDict()

    def pair(self, k: int, prepare: Prepare) -> Pair:
        """The pair (k-n, k) with its flow, without one where k-n is before the start.

        Args:
            k: the target's frame.
            prepare: gives the pair of a frame before its estimate.

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
    """A tracker's way through a segment, as far as it was asked for."""

    tracker: Tracker
    next: int
    found: dict[int, tuple[SceneFlow, float] | Exception] = field(default_factory=dict)
    lock: threading.Lock = field(default_factory=threading.Lock)

    def at(self, k: int, prepare: Prepare) -> tuple[SceneFlow, float]:
        """Flow of frame `k` and the seconds that its step took; what went wrong is raised again."""
        with self.lock:
            while self.next <= k:
                self.found[self.next] = self._step(self.next, prepare)
                self.next += 1
            found = self.found[k]
        if isinstance(found, Exception):
            raise found
        return found

    def _step(self, k: int, prepare: Prepare) -> tuple[SceneFlow, float] | Exception:
        # A frame that is broken, or fails the tracker, does not cost those after it their flow.
        try:
            window = prepare(k).window
            assert window is not None
            start = time.perf_counter()
            flow = self.tracker.step(window)
            return flow, time.perf_counter() - start
        except Exception as error:
            return error


def flows(recording: Recording, parameters: Parameters) -> Iterator[tuple[int, SceneFlow]]:
    """Estimate every pair (k-n, k) of a recording in order, as the page shows it.

    Args:
        recording: what is estimated.
        parameters: of the estimates, method included; trackers, too.

    Yields:
        k and the flow of the source's points.

    Raises:
        RecordingError: the file is broken at a frame.
    """
    estimator = PairEstimator(parameters)
    for k in range(parameters.n, len(recording)):
        flow = estimator.pair(k, lambda k: prepare_pair(recording, k, parameters)).flow
        assert flow is not None
        yield k, flow
