"""Cache of clouds, pairs and flows, shared by all sessions."""

import threading

from app.analysis.cache import Cache
from app.analysis.foreground import Foreground
from app.analysis.library import Opened
from app.analysis.pair_estimator import PairEstimator
from app.analysis.pairs import Pair, PreparedPair, make_pair, window_of
from app.analysis.timeline import RecordedTimeline
from estimator import Parameters, Stages, current_engine, find_method
from estimator.engines import REFERENCE
from estimator.engines import warm_up as warm_up_engine
from estimator.flow import ClusterResult
from estimator.outcomes import all_rounds
from recordings import Cloud

_MOST_POINTS = 2**19
"""Of the clouds, pairs or flows that are cached: 50 to 150 bytes each."""


_PATIENCE = 0.5  # seconds that a cloud in the background waits for the foreground


def warm_up() -> None:
    """Load the libraries of the reference, for what the compiled engine leaves to them."""
    warm_up_engine(REFERENCE)


class Estimates:
    """Computes clouds, pairs and flows on demand, and caches a bounded number of each.

    Those of large clouds are fewer, so that the memory is bounded, too.

    Args:
        clouds: maximum number of cached clouds.
        pairs: maximum number of pairs whose threshold-independent stages are cached.
        flows: maximum number of cached estimates.
        estimators: maximum number of parameter sets whose tracker segments are cached.

    Attributes:
        foreground: estimates that a user waits for.
    """

    def __init__(
        self, clouds: int = 256, pairs: int = 200, flows: int = 256, estimators: int = 16
    ) -> None:
        self._clouds: Cache[tuple, Cloud] = Cache(clouds, _points, _MOST_POINTS)
        self._prepared: Cache[tuple, tuple[Pair, Stages]] = Cache(
            pairs, lambda prepared: _points_of_pair(prepared[0]), _MOST_POINTS
        )
        self._pairs: Cache[tuple, Pair] = Cache(flows, _points_of_pair, _MOST_POINTS)
        self._estimators: Cache[tuple, PairEstimator] = Cache(estimators)
        self._recorded_timelines: Cache[tuple, RecordedTimeline] = Cache(16)
        self.foreground = Foreground()
        self._loading = threading.Lock()

    def pair(self, opened: Opened, k: int, parameters: Parameters) -> Pair:
        """The pair (k-n, k) without its flow.

        Raises:
            RecordingError: the file is broken there.
        """
        return self._prepare(opened, k, parameters).pair

    def estimated(self, opened: Opened, k: int, parameters: Parameters) -> Pair:
        """The pair (k-n, k) with its flow.

        Raises:
            RecordingError: the file is broken there.
        """

        def make() -> Pair:
            with self.foreground:
                return self._estimate(opened, k, parameters)

        return self._pairs.get((*_identity(opened), k, parameters), make)

    def estimated_in_background(self, opened: Opened, k: int, parameters: Parameters) -> Pair:
        """`estimated` for background work, which does not count as foreground and lets it pass."""
        if self.known(opened, k, parameters) is None:
            self._load_in_background(opened, k, parameters)
        return self._pairs.get(
            (*_identity(opened), k, parameters), lambda: self._estimate(opened, k, parameters)
        )

    def all_rounds(
        self, opened: Opened, k: int, parameters: Parameters
    ) -> tuple[ClusterResult, ...]:
        """Clusters of the pair (k-n, k) with every round of Algorithm 1, for `KeptRounds`.

        Raises:
            RecordingError: the file is broken there.
        """
        window = self._prepare(opened, k, parameters).window
        return () if window is None else all_rounds(window, parameters)

    def known(self, opened: Opened, k: int, parameters: Parameters) -> Pair | None:
        """The pair (k-n, k) with its flow if that is cached, else None."""
        return self._pairs.known((*_identity(opened), k, parameters))

    def recorded_timeline(self, opened: Opened) -> RecordedTimeline:
        """The part of a recording's timeline that needs no estimate."""
        return self._recorded_timelines.get(opened.key, lambda: RecordedTimeline(opened.recording))

    def cached(self, opened: Opened, parameters: Parameters) -> list[Pair]:
        """All cached pairs of a recording with these parameters."""
        # The cache is bounded, a recording's number of frames is not: search the cache.
        return [
            pair
            for (*identity, _, values), pair in self._pairs.items()
            if tuple(identity) == _identity(opened) and values == parameters
        ]

    def _estimate(self, opened: Opened, k: int, parameters: Parameters) -> Pair:
        estimator = PairEstimator(parameters)
        if find_method(parameters.method).tracker is not None:
            # A tracker's segments are kept, and belong to this opening of the file.
            estimator = self._estimators.get(
                (opened.number, current_engine().name, parameters), lambda: estimator
            )
        return estimator.pair(k, lambda frame: self._prepare(opened, frame, parameters))

    def _prepare(self, opened: Opened, k: int, parameters: Parameters) -> PreparedPair:
        def load(frame: int) -> Cloud:
            return self._cloud(opened, frame, parameters.max_range)

        pair, stages = self._prepared.get(
            (opened.key, k, parameters.n, parameters.max_range),
            lambda: (make_pair(opened.recording, k, parameters, load), Stages()),
        )
        # Windows are not cached: they read from the recording, which may be closed by then.
        return PreparedPair(pair, window_of(pair, opened.recording, load, stages))

    def _load_in_background(self, opened: Opened, k: int, parameters: Parameters) -> None:
        """Load the clouds of a pair, one after the other, as reading holds the interpreter.

        Who goes to a frame far away then shares it with one cloud at most, not with pairs.
        """
        for frame in (k - parameters.n, k):
            with self._loading:
                # Nothing that the foreground may ask the caches for is kept from it meanwhile.
                self.foreground.wait_until_quiet(0.0, _PATIENCE)
                if frame >= 0:
                    self._cloud(opened, frame, parameters.max_range)

    def _cloud(self, opened: Opened, k: int, max_range: float) -> Cloud:
        key = (opened.key, k, max_range)
        return self._clouds.get(key, lambda: opened.recording.cloud(k, max_range))


def _points(cloud: Cloud) -> int:
    return len(cloud.points)


def _points_of_pair(pair: Pair) -> int:
    return 0 if pair.source is None else len(pair.source.points)


def _identity(opened: Opened) -> tuple[tuple[str, int, int], str]:
    """What an estimate depends on beside its frame and parameters: the file and the engine."""
    return opened.key, current_engine().name
