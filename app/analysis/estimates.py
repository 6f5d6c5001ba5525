"""Pairs and their flow: computed once, remembered, and shared between sessions."""

import numpy as np

from app.analysis.cache import Cache
from app.analysis.foreground import Foreground
from app.analysis.library import Opened
from app.analysis.pair_estimator import PairEstimator
from app.analysis.pairs import Pair, PreparedPair, make_pair, window_of
from app.analysis.timeline import RecordedTimeline
from estimator import Parameters, Stages, estimate_scene_flow
from recordings import Cloud


def warm_up() -> None:
    """Load what the first estimate needs, so that it need not wait for it."""
    steps = np.linspace(0.0, 0.1, 6)
    patch = np.stack(np.meshgrid(steps, steps, [0.0]), axis=-1).reshape(-1, 3)
    cloud = np.vstack([patch, patch + 2.0])
    estimate_scene_flow(cloud, cloud, 1.0, Parameters(n_min=1))


class Estimates:
    """Clouds, pairs and flows, bounded in number, for all sessions.

    Args:
        clouds: how many clouds are remembered.
        pairs: of how many pairs the results are remembered that do not depend on the thresholds.
        flows: how many estimates are remembered.
        estimators: for how many sets of parameters a tracker's segments are remembered.

    Attributes:
        foreground: says when an estimate is waited for.
    """

    def __init__(
        self, clouds: int = 400, pairs: int = 200, flows: int = 400, estimators: int = 16
    ) -> None:
        self._clouds: Cache[tuple, Cloud] = Cache(clouds)
        self._prepared: Cache[tuple, tuple[Pair, Stages]] = Cache(pairs)
        self._pairs: Cache[tuple, Pair] = Cache(flows)
        self._estimators: Cache[tuple, PairEstimator] = Cache(estimators)
        self._recorded_timelines: Cache[tuple, RecordedTimeline] = Cache(16)
        self.foreground = Foreground()

    def pair(self, opened: Opened, k: int, parameters: Parameters) -> Pair:
        """The pair (k-n, k) without an estimate, its clouds taken from memory where they are.

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

        return self._pairs.get((opened.key, k, parameters), make)

    def estimated_in_background(self, opened: Opened, k: int, parameters: Parameters) -> Pair:
        """The same in the background: it is not counted as work in the foreground."""
        return self._pairs.get(
            (opened.key, k, parameters), lambda: self._estimate(opened, k, parameters)
        )

    def known(self, opened: Opened, k: int, parameters: Parameters) -> Pair | None:
        """The pair (k-n, k) with its flow where it was estimated already."""
        return self._pairs.known((opened.key, k, parameters))

    def recorded_timeline(self, opened: Opened) -> RecordedTimeline:
        """The recording's own part of its timeline."""
        return self._recorded_timelines.get(opened.key, lambda: RecordedTimeline(opened.recording))

    def cached(self, opened: Opened, parameters: Parameters) -> list[Pair]:
        """All pairs of a recording that were estimated with these parameters, as far as known."""
        # A recording may have many more frames than are remembered.
        return [
            pair
            for (key, _, values), pair in self._pairs.items()
            if key == opened.key and values == parameters
        ]

    def _estimate(self, opened: Opened, k: int, parameters: Parameters) -> Pair:
        estimator = self._estimators.get(
            (opened.key, parameters), lambda: PairEstimator(parameters)
        )
        return estimator.pair(k, lambda frame: self._prepare(opened, frame, parameters))

    def _prepare(self, opened: Opened, k: int, parameters: Parameters) -> PreparedPair:
        def load(frame: int) -> Cloud:
            return self._cloud(opened, frame, parameters.max_range)

        pair, stages = self._prepared.get(
            (opened.key, k, parameters.n, parameters.max_range),
            lambda: (make_pair(opened.recording, k, parameters, load), Stages()),
        )
        # The window reads from the recording, which may be closed before it is forgotten here.
        return PreparedPair(pair, window_of(pair, opened.recording, load, stages))

    def _cloud(self, opened: Opened, k: int, max_range: float) -> Cloud:
        key = (opened.key, k, max_range)
        return self._clouds.get(key, lambda: opened.recording.cloud(k, max_range))
